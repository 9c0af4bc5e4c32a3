// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "relucent/calibration/json.h"
#include "relucent/pipeline/prove.h"

// Where the type is, as the library looks for them there.
namespace relucent::pipeline {

/// {"psnr", "delta_e"}. JSON knows no NaN: a psnr of null says that nothing is reachable.
inline void to_json(calibration::Json& json, const PictureError& error) {
  json = {{"psnr", error.psnr}, {"delta_e", error.deltaE}};
}
inline void from_json(const calibration::Json& json, PictureError& error) {
  const calibration::Json& psnr = json.at("psnr");
  error = {psnr.is_null() ? std::numeric_limits<double>::quiet_NaN() : psnr.get<double>(),
           json.at("delta_e").get<double>()};
}

}  // namespace relucent::pipeline
