// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <cstdint>

namespace relucent {

/// Three significant digits by the locale; very large and small ones as 7.9 x 10^-4.
QString numberText(double value);
/// "98.6 %" of a share, with a narrow no-break space.
QString percentText(double share);
/// 21 480: grouped with narrow no-break spaces.
QString countText(std::uint64_t count);
/// "412 MB".
QString bytesText(std::uint64_t bytes);
/// "1/30 s", "0.25 s", "2 s".
QString exposureText(double seconds);
/// "10" and a raised exponent.
QString powerOfTen(int exponent);

}  // namespace relucent
