// SPDX-License-Identifier: MIT
#include "relucent/mapping/mpcdi.h"

#include <fmt/format.h>

#include "relucent/base/zip_file.h"
#include "relucent/image/picture_files.h"
#include "relucent/mapping/pfm.h"

namespace relucent::mapping {
namespace {

constexpr int alphaBits = 16;

std::string regionName(std::size_t projector) {
  return fmt::format("projector-{}", projector + 1);
}

/// Both maps of one projector; the warp's third value has no meaning in this profile.
image::Image warpOf(const ProjectorMaps& maps, std::size_t projector) {
  image::Image warp(maps.projectors.size(projector), 3);
  const std::array<float, 2>* place = maps.place.data() + maps.projectors.offset(projector);
  for (std::size_t j = 0; j < warp.pixels(); ++j) {
    warp.pixel(j)[0] = place[j][0];
    warp.pixel(j)[1] = place[j][1];
  }
  return warp;
}

}  // namespace

void writeMpcdi(const std::filesystem::path& path, const ProjectorMaps& maps, Size canvas,
                const std::string& date) {
  ZipEntries entries;
  std::string regions, files;
  for (std::size_t projector = 0; projector < maps.projectors.devices(); ++projector) {
    const std::string name = regionName(projector);
    const Size size = maps.projectors.size(projector);
    entries[name + "-warp.pfm"] = encodePfm(warpOf(maps, projector));
    entries[name + "-alpha.png"] =
        image::encodePng(image::imageFromStack(maps.alpha, maps.projectors, projector), alphaBits);
    regions += fmt::format(
        "      <region id=\"{}\" Xresolution=\"{}\" Yresolution=\"{}\" x=\"0\" y=\"0\" xsize=\"1\" "
        "ysize=\"1\"/>\n",
        name, size.width, size.height);
    // Readers ask for the unit and origin of positions also where there are none.
    files += fmt::format(
        "    <fileset region=\"{0}\">\n"
        "      <geometryWarpFile>\n"
        "        <path>{0}-warp.pfm</path>\n"
        "        <interpolation>linear</interpolation>\n"
        "        <geometricUnit>unknown</geometricUnit>\n"
        "        <originof3DData>unknown</originof3DData>\n"
        "      </geometryWarpFile>\n"
        "      <alphaMap>\n"
        "        <path>{0}-alpha.png</path>\n"
        "        <componentDepth>3</componentDepth>\n"
        "        <bitDepth>{1}</bitDepth>\n"
        "        <gammaEmbedded>1.0</gammaEmbedded>\n"
        "      </alphaMap>\n"
        "    </fileset>\n",
        name, alphaBits);
  }
  entries["mpcdi.xml"] = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<MPCDI profile=\"2d\" level=\"1\" date=\"{}\" version=\"1.0\">\n"
      "  <display>\n"
      "    <buffer id=\"content\" Xresolution=\"{}\" Yresolution=\"{}\">\n"
      "{}"
      "    </buffer>\n"
      "  </display>\n"
      "  <files>\n"
      "{}"
      "  </files>\n"
      "</MPCDI>\n",
      date, canvas.width, canvas.height, regions, files);
  writeZip(path, entries);
}

}  // namespace relucent::mapping
