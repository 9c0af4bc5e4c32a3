// SPDX-License-Identifier: MIT
#include "relucent/devices/sensor_frame.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <tuple>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::devices {
namespace {

using Named = std::pair<std::string_view, SensorLayout>;
constexpr std::array<Named, 7> layouts{{{"Mono", SensorLayout::mono},
                                        {"BayerRG", SensorLayout::bayerRG},
                                        {"BayerGR", SensorLayout::bayerGR},
                                        {"BayerGB", SensorLayout::bayerGB},
                                        {"BayerBG", SensorLayout::bayerBG},
                                        {"RGB", SensorLayout::rgb},
                                        {"BGR", SensorLayout::bgr}}};

bool isInterleaved(SensorLayout layout) {
  return layout == SensorLayout::rgb || layout == SensorLayout::bgr;
}
bool isFiltered(SensorLayout layout) {
  return layout != SensorLayout::mono && !isInterleaved(layout);
}

std::size_t bytesOf(const SensorFrame& frame) {
  const std::size_t samples = frame.size.count() * (isInterleaved(frame.format.layout) ? 3 : 1);
  return samples * (frame.format.bits > 8 ? 2 : 1);
}

/// The samples of a frame by their index.
template <typename Sample>
class Samples {
 public:
  explicit Samples(const SensorFrame& frame) : bytes_(frame.bytes.data()) {}
  std::uint32_t operator[](std::size_t index) const {
    if constexpr (sizeof(Sample) == 1) return bytes_[index];
    return bytes_[2 * index] | static_cast<std::uint32_t>(bytes_[2 * index + 1]) << 8;
  }

 private:
  const std::uint8_t* bytes_;
};

/// Where in a 2x2 cell (index 2 y + x) red lies; blue lies opposite, green in the other two.
std::size_t redIn(SensorLayout layout) {
  switch (layout) {
    case SensorLayout::bayerGR:
      return 1;
    case SensorLayout::bayerGB:
      return 2;
    case SensorLayout::bayerBG:
      return 3;
    default:
      return 0;
  }
}

/// The same as decoded() for codes with levels; not interleaved.
template <typename Sample>
image::Image levelled(const SensorFrame& frame) {
  const Samples<Sample> samples(frame);
  const SensorLevels& levels = *frame.levels;
  const SensorLayout layout = frame.format.layout;
  const auto width = static_cast<std::size_t>(frame.size.width);
  const std::size_t red = redIn(layout);
  std::array<float, 4> scale{};
  for (std::size_t i = 0; i < 4; ++i) scale[i] = 1.0f / (levels.white - levels.black[i]);
  auto signal = [&](std::size_t index, std::size_t place) {
    return (static_cast<float>(samples[index]) - levels.black[place]) * scale[place];
  };

  image::Image image(photographSize(frame.size, frame.format), 3);
  parallelFor(0, static_cast<std::size_t>(image.height()), 16, [&](std::size_t y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(image.width()); ++x) {
      const std::span<float> pixel = image.pixel(y * static_cast<std::size_t>(image.width()) + x);
      if (layout == SensorLayout::mono) {
        std::fill(pixel.begin(), pixel.end(), signal(y * width + x, 2 * (y % 2) + x % 2));
        continue;
      }
      const std::size_t corner = 2 * (y * width + x);
      const std::array<float, 4> cell{signal(corner, 0), signal(corner + 1, 1), signal(corner + width, 2),
                                      signal(corner + width + 1, 3)};
      pixel[0] = cell[red];
      pixel[1] = 0.5f * (cell[red ^ 1u] + cell[red ^ 2u]);
      pixel[2] = cell[red ^ 3u];
    }
  });
  return image;
}

template <typename Sample>
image::Image decoded(const SensorFrame& frame) {
  const Samples<Sample> samples(frame);
  const SensorLayout layout = frame.format.layout;
  const Size size = photographSize(frame.size, frame.format);
  const double full = static_cast<double>((1u << static_cast<unsigned>(photographBits(frame.format))) - 1u);
  const auto width = static_cast<std::size_t>(frame.size.width);
  const std::size_t red = redIn(layout);

  image::Image image(size, 3);
  parallelFor(0, static_cast<std::size_t>(size.height), 16, [&](std::size_t y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(size.width); ++x) {
      std::array<std::uint32_t, 3> codes{};
      if (layout == SensorLayout::mono) {
        codes.fill(samples[y * width + x]);
      } else if (isInterleaved(layout)) {
        for (std::size_t c = 0; c < 3; ++c)
          codes[layout == SensorLayout::rgb ? c : 2 - c] = samples[3 * (y * width + x) + c];
      } else {
        const std::size_t corner = 2 * (y * width + x);
        const std::array<std::uint32_t, 4> cell{samples[corner], samples[corner + 1], samples[corner + width],
                                                samples[corner + width + 1]};
        codes = {2 * cell[red], cell[red ^ 1u] + cell[red ^ 2u], 2 * cell[red ^ 3u]};
      }
      for (int c = 0; c < 3; ++c)
        image.at(static_cast<int>(x), static_cast<int>(y), c) =
            static_cast<float>(codes[static_cast<std::size_t>(c)] / full);
    }
  });
  return image;
}

}  // namespace

std::optional<SensorFormat> sensorFormatFromName(std::string_view name) {
  for (const auto& [prefix, layout] : layouts) {
    if (!name.starts_with(prefix)) continue;
    const std::string_view number = name.substr(prefix.size());
    int bits = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), bits);
    if (error != std::errc() || end != number.data() + number.size() || bits < 8 || bits > 16)
      return std::nullopt;
    return SensorFormat{layout, bits};
  }
  return std::nullopt;
}

std::string nameOf(const SensorFormat& format) {
  for (const auto& [prefix, layout] : layouts)
    if (layout == format.layout) return fmt::format("{}{}", prefix, format.bits);
  return {};
}

std::optional<SensorFormat> bestFormat(const std::vector<std::string>& names) {
  std::optional<SensorFormat> best;
  auto worth = [](const SensorFormat& format) {
    return std::tuple(format.layout != SensorLayout::mono, !isInterleaved(format.layout), format.bits);
  };
  for (const std::string& name : names) {
    const std::optional<SensorFormat> format = sensorFormatFromName(name);
    if (format && (!best || worth(*format) > worth(*best))) best = format;
  }
  return best;
}

Size photographSize(Size sensor, const SensorFormat& format) {
  return isFiltered(format.layout) ? Size{sensor.width / 2, sensor.height / 2} : sensor;
}

Size sensorSize(Size photograph, const SensorFormat& format) {
  return isFiltered(format.layout) ? Size{2 * photograph.width, 2 * photograph.height} : photograph;
}

int photographBits(const SensorFormat& format) {
  return format.bits + (isFiltered(format.layout) ? 1 : 0);
}

int photographBits(const SensorFrame& frame) {
  return frame.levels ? 0 : photographBits(frame.format);
}

image::Image photographOf(const SensorFrame& frame, const std::string& camera) {
  if (frame.bytes.size() < bytesOf(frame))
    throw Error(ErrorKind::device,
                RELUCENT_MESSAGE("device.photograph-truncated",
                                 "a photograph of {} pixels as {} came with {} of {} bytes")
                    .with(as::size(frame.size), nameOf(frame.format), as::bytes(frame.bytes.size()),
                          as::bytes(bytesOf(frame))),
                RELUCENT_MESSAGE("device.restart-or-change-pixel-format",
                                 "switch the camera off and on, or choose another of its pixel formats"),
                camera);
  if (frame.levels) {
    require(!isInterleaved(frame.format.layout), "no levels of {}", nameOf(frame.format));
    for (float black : frame.levels->black)
      require(frame.levels->white > black, "white {} above black {}", frame.levels->white, black);
    return frame.format.bits > 8 ? levelled<std::uint16_t>(frame) : levelled<std::uint8_t>(frame);
  }
  return frame.format.bits > 8 ? decoded<std::uint16_t>(frame) : decoded<std::uint8_t>(frame);
}

}  // namespace relucent::devices
