// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/compensation/stacked_views.h"
#include "core/inverse/synthetic_transport.h"
#include "relucent/compensation/methods.h"
#include "relucent/engine/engine_plan.h"
#include "relucent/transport/leaf_sharing.h"
#include "relucent/transport/shared_colours.h"

namespace relucent::synthetic {

/// A venue that the engine can run in, with its inverse.
struct EngineScene {
  compensation::MeasuredVenue venue;
  inverse::WindowInverse inverse;
  std::vector<linearization::ProjectorResponse> responses;
  compensation::TargetSettings target{};
};

inline compensation::MeasuredVenue venueOf(Scene scene) {
  compensation::MeasuredVenue venue;
  venue.flood = scene.transport.floodlight();
  venue.transport = std::move(scene.transport);
  venue.black = std::move(scene.black);
  venue.usable = std::move(scene.usable);
  return venue;
}

inline EngineScene engineScene(compensation::MeasuredVenue venue, int tile = 4) {
  EngineScene scene;
  Progress silent;
  inverse::WindowSettings windows;
  windows.tile = tile;
  scene.inverse = inverse::computeWindows(venue.transport, venue.usable, windows, silent);
  scene.responses.resize(venue.transport.projectors().devices());
  scene.venue = std::move(venue);
  return scene;
}

/// Two cameras and two projectors of odd sizes; every colour of far light has a mixing of its own.
inline compensation::MeasuredVenue severalDevices(std::uint64_t seed) {
  Rasters cameras({{21, 15}, {10, 7}}), projectors({{26, 17}, {13, 11}});
  transport::NodeLayout layout(projectors);
  transport::BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 1.0f));
  for (std::size_t camera = 0; camera < 2; ++camera) {
    for (std::size_t local = 0; local < cameras.size(camera).count(); ++local) {
      std::size_t row = cameras.offset(camera) + local;
      Random random{seed, row};
      Pixel place = pixelAt(cameras.size(camera), local);
      transport::ColourBlock mixing;
      for (int i = 0; i < 9; ++i)
        mixing.data()[i] = (0.3f + 0.4f * random.uniformFloat()) * (i % 4 == 0 ? 1.0f : 0.1f);
      for (int projector = 0; projector < 2; ++projector) {
        Size size = projectors.size(static_cast<std::size_t>(projector));
        int cx = place.x * size.width / cameras.size(camera).width;
        int cy = place.y * size.height / cameras.size(camera).height;
        for (int y = std::max(0, cy - 1); y <= std::min(cy + 1, size.height - 1); ++y)
          for (int x = std::max(0, cx - 1); x <= std::min(cx + 1, size.width - 1); ++x)
            builder.add(row, layout.index({projector, 0, x, y}),
                        ((x == cx && y == cy ? 0.4f : 0.04f) * mixing).eval());
        transport::ColourBlock far = mixing;
        far.col(static_cast<Eigen::Index>(random.below(3))) *= 1.5f;
        builder.add(row, layout.index({projector, 3, 0, 0}), (0.05f * far).eval());
      }
    }
  }
  compensation::MeasuredVenue venue;
  venue.transport = transport::TransportMatrix(cameras, projectors, builder.build());
  venue.flood = venue.transport.floodlight();
  venue.black.assign(venue.flood.size(), 0.002f);
  venue.usable.assign(cameras.count(), 1);
  for (std::size_t i = 0; i < venue.usable.size(); i += 37) venue.usable[i] = 0;
  Random doubts{seed, cameras.count()};
  for (std::size_t i = 0; i < venue.usable.size(); ++i)
    venue.trust.push_back(0.3f + 0.7f * doubts.uniformFloat());
  return venue;
}

/// Sizes that nothing divides, a node that every camera pixel sees, and camera pixels that see nothing at
/// all, every other of them unusable.
inline compensation::MeasuredVenue holes(std::uint64_t seed) {
  const Rasters cameras(Size{37, 23}), projectors(Size{29, 31});
  transport::NodeLayout layout(projectors);
  transport::BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 1.0f));
  compensation::MeasuredVenue venue;
  for (std::size_t row = 0; row < cameras.count(); ++row) {
    const Pixel place = pixelAt(cameras.size(0), row);
    const bool empty = place.x > 25;
    venue.usable.push_back(!empty || row % 2 == 0);
    if (empty) continue;
    Random random{seed, row};
    transport::ColourBlock mixing;
    for (int i = 0; i < 9; ++i)
      mixing.data()[i] = (0.3f + 0.4f * random.uniformFloat()) * (i % 4 == 0 ? 1.0f : 0.1f);
    int cx = place.x * 29 / 37, cy = place.y * 31 / 23;
    for (int y = std::max(0, cy - 1); y <= std::min(cy + 1, 30); ++y)
      for (int x = std::max(0, cx - 1); x <= std::min(cx + 1, 28); ++x)
        builder.add(row, layout.index({0, 0, x, y}), ((x == cx && y == cy ? 0.5f : 0.05f) * mixing).eval());
    builder.add(row, layout.index({0, 5, 0, 0}), (0.1f * mixing).eval());
  }
  venue.transport = transport::TransportMatrix(cameras, projectors, builder.build());
  venue.flood = venue.transport.floodlight();
  venue.black.assign(venue.flood.size(), 0.002f);
  return venue;
}

/// The same T, near enough, as dense patterns measure it: colours are shared, and leaves by neighbours.
inline transport::TransportMatrix sharing(const transport::TransportMatrix& own) {
  const transport::ColumnKinds kinds = transport::nearAndFar(own.layout(), 2);
  transport::SharedColourEncoder encoder(kinds);
  transport::SharedColourWriter writer(own.layout().count(), own.cameras().count(), kinds, 0);
  transport::SharedColourRow encoded;
  std::vector<transport::ColourBlock> blocks;
  for (std::size_t row = 0; row < own.cameras().count(); ++row) {
    const transport::LeafRow leaves = own.row(row);
    blocks.clear();
    for (std::size_t entry = 0; entry < leaves.size(); ++entry) blocks.push_back(leaves.block(entry));
    encoder.encode(leaves.columns(), blocks, encoded);
    writer.add(encoded);
  }
  Progress quiet;
  return transport::withSharedLeaves({own.cameras(), own.projectors(), writer.build()},
                                     transport::sharingTolerance, quiet);
}

/// Scenes by name, for data-driven tests.
inline const std::vector<std::string>& engineSceneNames() {
  static const std::vector<std::string> names{
      "wall",         "defocus",      "coarse tiles",     "several devices", "several views",
      "single pixel", "holes",        "neighbours share", "several share",   "two views",
      "weights",      "own pictures", "one asks",         "light",           "weights of light",
      "hue",          "hue in half"};
  return names;
}

inline EngineScene madeEngineScene(const std::string& name) {
  if (name == "several devices") return engineScene(severalDevices(3));
  if (name == "several views") {
    compensation::MeasuredVenue venue = severalDevices(3);
    venue.views = compensation::viewMap(venue.transport, venue.usable);
    return engineScene(std::move(venue));
  }
  if (name == "light") {
    EngineScene scene = engineScene(venueOf(makeScene({})));
    scene.target = compensation::TargetSettings::ofLight();
    return scene;
  }
  if (name == "hue" || name == "hue in half") {
    EngineScene scene = engineScene(venueOf(makeScene({})));
    scene.target.reachablePercentile = 40.0;
    scene.target.clipping = name == "hue" ? compensation::Clipping::hue : compensation::Clipping::half;
    return scene;
  }
  if (name == "two views" || name == "weights" || name == "own pictures" || name == "one asks" ||
      name == "weights of light") {
    EngineScene scene = engineScene(twoViews());
    std::vector<compensation::ViewSettings>& views = scene.target.views;
    if (name == "weights of light") scene.target = compensation::TargetSettings::ofLight();
    if (name == "weights" || name == "weights of light") views = {{0.3, {}, {}}, {1.0, {}, {}}};
    if (name == "own pictures") {
      scene.target.corners = compensation::Corners{{{5, 3}, {35, 4}, {33, 25}, {6, 24}}};
      views = {{1.0, {}, {}}, {0.5, compensation::ViewPlacement::own, {}}};
    }
    if (name == "one asks")
      views = {{0.0, {}, {}},
               {1.0, compensation::ViewPlacement::own, compensation::uprightCorners(6, 5, 22, 16)}};
    return scene;
  }
  if (name == "holes") return engineScene(holes(4));
  if (name == "several share") {
    compensation::MeasuredVenue venue = severalDevices(3);
    venue.transport = sharing(venue.transport);
    return engineScene(std::move(venue));
  }
  if (name == "neighbours share") {
    compensation::MeasuredVenue venue = venueOf(makeScene({{50, 37}, {41, 29}, 2, 0.8, 2.0}));
    venue.transport = sharing(venue.transport);
    return engineScene(std::move(venue));
  }
  SceneSettings settings;
  if (name == "defocus") settings = {{50, 37}, {41, 29}, 2, 0.8, 2.0};
  if (name == "coarse tiles") return engineScene(venueOf(makeScene({{33, 30}, {24, 20}, 5})), 8);
  if (name == "single pixel") {
    SceneSettings tiny{{1, 1}, {6, 6}, 4, 0.4, 0.4, 0.0, 0.0};
    tiny.interreflection = 0.0;
    Scene scene = makeScene(tiny);
    scene.usable.assign(scene.usable.size(), 1);
    return engineScene(venueOf(std::move(scene)));
  }
  return engineScene(venueOf(makeScene(settings)));
}

/// Made once for all rows of a test: its windows take longer than most of what is done with them.
inline EngineScene engineSceneOf(const std::string& name) {
  static std::map<std::string, EngineScene> made;
  if (!made.contains(name)) made.emplace(name, madeEngineScene(name));
  return made.at(name);
}

}  // namespace relucent::synthetic
