// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <cstdint>

namespace relucent::gui {

/// Isolates left-to-right text, such as numbers with units and pairs, for use in a right-to-left sentence;
/// adds nothing in left-to-right languages.
QString isolated(const QString& text);
/// Three significant digits by the locale; very large and small ones as 7.9 x 10^-4.
QString numberText(double value);
/// With a given number of decimals, by the locale.
QString decimalText(double value, int decimals);
/// "98.6 %" of a share, with a narrow no-break space.
QString percentText(double share);
/// "± 1.2 %" of a share that may be too little or too much.
QString marginText(double share);
/// 21 480: grouped with narrow no-break spaces.
QString countText(std::uint64_t count);
/// 21 480, 30.1 million, 944 million, 2.1 billion: with a word where there are many digits.
QString largeText(std::uint64_t count);
/// "412 MB".
QString bytesText(std::uint64_t bytes);
/// "1/30 s", "0.25 s", "2 s".
QString exposureText(double seconds);
/// "1024 x 768": of a screen or a picture.
QString sizeText(int width, int height);
/// "12, 34": position of a pixel.
QString placeText(int x, int y);
/// A sentence of tr(..., count), with its count grouped as by countText().
QString groupedText(QString sentence, int count);

}  // namespace relucent::gui
