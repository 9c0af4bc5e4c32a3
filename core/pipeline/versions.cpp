// SPDX-License-Identifier: MIT
#include "relucent/pipeline/versions.h"

#include <OpenEXR/OpenEXRConfig.h>
#include <fmt/format.h>
#include <oneapi/tbb/version.h>
#include <xxhash.h>
#include <zip.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include "relucent/pjlink/protocol.h"

namespace relucent::pipeline {
namespace {

std::string dotted(unsigned major, unsigned minor, unsigned patch) {
  return fmt::format("{}.{}.{}", major, minor, patch);
}

}  // namespace

std::string relucentVersion() {
  return RELUCENT_VERSION;
}

std::vector<LibraryVersion> coreLibraries() {
  unsigned hash = XXH_versionNumber();
  std::vector<LibraryVersion> libraries{
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Embree", RELUCENT_EMBREE_VERSION},
      {"GLib", pjlink::glibVersion()},
      {"JSON for Modern C++",
       dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"OpenCV", cv::getVersionString()},
      {"OpenEXR", OPENEXR_VERSION_STRING},
      {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"libepoxy", RELUCENT_EPOXY_VERSION},
      {"libzip", zip_libzip_version()},
      {"oneTBB", TBB_runtime_version()},
      {"xxHash", dotted(hash / 10000, hash / 100 % 100, hash % 100)},
  };
#ifdef RELUCENT_ARAVIS_VERSION
  libraries.insert(libraries.begin(), {"Aravis", RELUCENT_ARAVIS_VERSION});
#endif
  return libraries;
}

std::string versionText(const std::string& program, const std::vector<LibraryVersion>& libraries) {
  std::string text = fmt::format("{} {}\n", program, relucentVersion());
  for (const LibraryVersion& library : libraries)
    text += fmt::format("  {} {}\n", library.name, library.version);
  return text;
}

}  // namespace relucent::pipeline
