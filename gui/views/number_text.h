// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <cstdint>

namespace relucent {

/// What is read from the left, as numbers with units and pairs are, within a sentence that may be read from
/// the right; nothing is added where the program is read from the left.
QString isolated(const QString& text);
/// Three significant digits by the locale; very large and small ones as 7.9 x 10^-4.
QString numberText(double value);
/// As many decimals as are asked for, by the locale.
QString decimalText(double value, int decimals);
/// "98.6 %" of a share, with a narrow no-break space.
QString percentText(double share);
/// 21 480: grouped with narrow no-break spaces.
QString countText(std::uint64_t count);
/// "412 MB".
QString bytesText(std::uint64_t bytes);
/// "1/30 s", "0.25 s", "2 s".
QString exposureText(double seconds);
/// "1024 x 768": of a screen or a picture.
QString sizeText(int width, int height);
/// "12, 34": where a pixel is.
QString placeText(int x, int y);
/// A sentence of tr(..., count), with the thousands of its count apart as countText() has them.
QString groupedText(QString sentence, int count);

}  // namespace relucent
