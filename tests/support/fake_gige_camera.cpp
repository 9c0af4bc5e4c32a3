// SPDX-License-Identifier: MIT
#include "support/fake_gige_camera.h"

#include <arv.h>

#include <cmath>

#include "relucent/base/file.h"
#include "relucent/devices/temporary_folder.h"

namespace relucent::test {
namespace {

/// Formats that the library's own description of the camera leaves out.
constexpr const char* moreFormats =
    R"(<EnumEntry Name="BayerRG12" NameSpace="Standard"><Value>17825809</Value></EnumEntry>
<EnumEntry Name="BayerGB10" NameSpace="Standard"><Value>17825806</Value></EnumEntry>
<EnumEntry Name="Mono10" NameSpace="Standard"><Value>17825795</Value></EnumEntry>
<EnumEntry Name="Mono12" NameSpace="Standard"><Value>17825797</Value></EnumEntry>
)";

void replaceOnce(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  if (place != std::string::npos) text.replace(place, from.size(), to);
}

/// The camera's description of itself, as the library has it, with what the tests need.
std::string descriptionOf(const FakeGigeSettings& settings) {
  ArvFakeCamera* camera = arv_fake_camera_new("any");
  std::size_t size = 0;
  const char* xml = arv_fake_camera_get_genicam_xml(camera, &size);
  std::string text(xml, size);
  g_object_unref(camera);
  while (!text.empty() && text.back() == '\0') text.pop_back();

  replaceOnce(text, "<EnumEntry Name=\"Mono8\"", moreFormats + std::string("<EnumEntry Name=\"Mono8\""));
  if (!settings.sensor.empty()) {
    const auto value = [](int side) { return "<Value>" + std::to_string(side) + "</Value>"; };
    replaceOnce(text, "<pValue>SensorWidthRegister</pValue>", value(settings.sensor.width));
    replaceOnce(text, "<pValue>SensorHeightRegister</pValue>", value(settings.sensor.height));
  }
  if (settings.longestKept > 0) {
    const std::string limit = std::to_string(settings.longestKept);
    replaceOnce(text, "<FormulaTo>FROM</FormulaTo>",
                "<FormulaTo>(FROM &gt; " + limit + ") ? " + limit + " : FROM</FormulaTo>");
  }
  return text;
}

std::string formatName(ArvPixelFormat format) {
  switch (format) {
    case ARV_PIXEL_FORMAT_BAYER_RG_12:
      return "BayerRG12";
    case ARV_PIXEL_FORMAT_BAYER_GB_10:
      return "BayerGB10";
    case ARV_PIXEL_FORMAT_MONO_8:
      return "Mono8";
    case ARV_PIXEL_FORMAT_MONO_10:
      return "Mono10";
    case ARV_PIXEL_FORMAT_MONO_12:
      return "Mono12";
    case ARV_PIXEL_FORMAT_MONO_16:
      return "Mono16";
    default:
      return "other";
  }
}

}  // namespace

struct FakeGigeCamera::Parts {
  FakeGigeSettings settings;
  Look look;
  devices::TemporaryFolder folder;
  std::string description;
  ArvGvFakeCamera* camera = nullptr;

  static void fill(ArvBuffer* buffer, void* data, guint32 exposure, guint32 gain, ArvPixelFormat format) {
    auto* parts = static_cast<Parts*>(data);
    std::size_t size = 0;
    auto* bytes = static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, &size)));
    parts->look({bytes,
                 {arv_buffer_get_image_width(buffer), arv_buffer_get_image_height(buffer)},
                 {arv_buffer_get_image_x(buffer), arv_buffer_get_image_y(buffer)},
                 formatName(format),
                 exposure * 1e-6,
                 gain});
  }
};

FakeGigeCamera::FakeGigeCamera(FakeGigeSettings settings, Look look) : parts_(std::make_unique<Parts>()) {
  parts_->settings = std::move(settings);
  parts_->look = std::move(look);
  const std::filesystem::path file = parts_->folder.path() / "camera.xml";
  writeFileAtomically(file, descriptionOf(parts_->settings));
  parts_->description = file.string();
  plug();
}

FakeGigeCamera::~FakeGigeCamera() {
  unplug();
}

bool FakeGigeCamera::isRunning() const {
  return parts_->camera != nullptr && arv_gv_fake_camera_is_running(parts_->camera) != FALSE;
}

void FakeGigeCamera::unplug() {
  if (parts_->camera != nullptr) g_object_unref(parts_->camera);
  parts_->camera = nullptr;
}

void FakeGigeCamera::plug() {
  unplug();
  parts_->camera = arv_gv_fake_camera_new_full(parts_->settings.address.c_str(),
                                               parts_->settings.serial.c_str(), parts_->description.c_str());
  ArvFakeCamera* camera = arv_gv_fake_camera_get_fake_camera(parts_->camera);
  arv_fake_camera_set_fill_pattern(camera, &Parts::fill, parts_.get());
  arv_fake_camera_set_trigger_frequency(camera, parts_->settings.framesPerSecond);
  losePackets(parts_->settings.lostPackets);
}

void FakeGigeCamera::losePackets(double share) {
  if (parts_->camera != nullptr) g_object_set(parts_->camera, "gvsp-lost-ratio", share, nullptr);
}

void FakeGigeCamera::setSensorSize(Size size) {
  ArvFakeCamera* camera = arv_gv_fake_camera_get_fake_camera(parts_->camera);
  arv_fake_camera_write_register(camera, ARV_FAKE_CAMERA_REGISTER_WIDTH, static_cast<guint32>(size.width));
  arv_fake_camera_write_register(camera, ARV_FAKE_CAMERA_REGISTER_HEIGHT, static_cast<guint32>(size.height));
}

void fillBayerRG12(const image::Image& photograph, std::uint8_t* bytes) {
  const auto width = static_cast<std::size_t>(2 * photograph.width());
  auto put = [&](int x, int y, float signal) {
    const auto code = static_cast<std::uint32_t>(std::lround(signal * 4095.0f));
    std::uint8_t* place = bytes + 2 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x));
    place[0] = static_cast<std::uint8_t>(code & 0xffu);
    place[1] = static_cast<std::uint8_t>(code >> 8);
  };
  for (int y = 0; y < photograph.height(); ++y)
    for (int x = 0; x < photograph.width(); ++x) {
      put(2 * x, 2 * y, photograph.at(x, y, 0));
      put(2 * x + 1, 2 * y, photograph.at(x, y, 1));
      put(2 * x, 2 * y + 1, photograph.at(x, y, 1));
      put(2 * x + 1, 2 * y + 1, photograph.at(x, y, 2));
    }
}

}  // namespace relucent::test
