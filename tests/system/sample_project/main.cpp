// SPDX-License-Identifier: MIT
// Measures a simulated venue, the corner of a room, and computes what to project so that it shows a picture.
//   compensate-corner PICTURE FOLDER
#include <relucent/base/error.h>
#include <relucent/pipeline/calibrate.h>
#include <relucent/pipeline/compensate.h>

#include <filesystem>
#include <iostream>

int main(int count, char** arguments) {
  using namespace relucent;
  if (count != 3) {
    std::cerr << "usage: compensate-corner PICTURE FOLDER\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = arguments[2];
    Progress progress;

    pipeline::CalibrateSettings measured;
    measured.rig = venue::VenueSettings{.name = "corner", .projector = {64, 48}, .camera = {40, 30}};
    const pipeline::CalibrateResult calibration =
        pipeline::calibrate(folder / "calibration", measured, folder / "cache", progress);

    pipeline::CompensateSettings wanted{.image = arguments[1], .out = folder / "shown"};
    const pipeline::CompensateResult shown = pipeline::compensate(folder / "calibration", wanted, progress);

    std::cout << calibration.patterns << " patterns photographed, " << calibration.leaves << " leaves of T\n"
              << nameOf(shown.method) << ": " << shown.psnrPredicted << " dB expected\n";
  } catch (const Error& failure) {
    std::cerr << failure.what() << "\n";
    return 1;
  }
}
