// SPDX-License-Identifier: MIT
#include "relucent/devices/gphoto/gphoto_port.h"

#include <fmt/format.h>
#include <gphoto2/gphoto2.h>
#include <locale.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <thread>

namespace relucent::devices {
namespace {

using std::chrono::microseconds;

template <auto release>
struct Releaser {
  template <typename Thing>
  void operator()(Thing* thing) const {
    release(thing);
  }
};
using Context = std::unique_ptr<GPContext, Releaser<gp_context_unref>>;
using Names = std::unique_ptr<::CameraList, Releaser<gp_list_free>>;
using Abilities = std::unique_ptr<CameraAbilitiesList, Releaser<gp_abilities_list_free>>;
using Ports = std::unique_ptr<GPPortInfoList, Releaser<gp_port_info_list_free>>;
using Widget = std::unique_ptr<CameraWidget, Releaser<gp_widget_free>>;
using File = std::unique_ptr<CameraFile, Releaser<gp_file_unref>>;
using OwnedCamera = std::unique_ptr<Camera, Releaser<gp_camera_unref>>;

/// English and points in numbers for the calls that this thread makes meanwhile: libgphoto2 translates the
/// values of settings.
class PlainLocale {
 public:
  PlainLocale() : before_(uselocale(plain())) {}
  ~PlainLocale() { uselocale(before_); }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  static locale_t plain() {
    static const locale_t locale = newlocale(LC_ALL_MASK, "C", nullptr);
    return locale;
  }
  locale_t before_;
};

GphotoFault faultOf(int result) {
  switch (result) {
    case GP_ERROR_MODEL_NOT_FOUND:
    case GP_ERROR_IO_USB_FIND:
    case GP_ERROR_UNKNOWN_PORT:
      return GphotoFault::absent;
    case GP_ERROR_IO_USB_CLAIM:
    case GP_ERROR_IO_LOCK:
      return GphotoFault::claimed;
    case GP_ERROR_CAMERA_BUSY:
      return GphotoFault::busy;
    case GP_ERROR_NO_SPACE:
      return GphotoFault::full;
    case GP_ERROR_IO:
    case GP_ERROR_TIMEOUT:
    case GP_ERROR_IO_INIT:
    case GP_ERROR_IO_READ:
    case GP_ERROR_IO_WRITE:
    case GP_ERROR_IO_UPDATE:
    case GP_ERROR_IO_USB_CLEAR_HALT:
      return GphotoFault::silent;
    default:
      return GphotoFault::refused;
  }
}

class LibraryPort : public GphotoPort {
 public:
  LibraryPort() : context_(gp_context_new()) {
    gp_context_set_error_func(
        context_.get(),
        [](GPContext*, const char* text, void* self) { static_cast<LibraryPort*>(self)->said_ = text; },
        this);
  }
  ~LibraryPort() override { LibraryPort::close(); }

  std::vector<GphotoCamera> list() override {
    const PlainLocale plain;
    ::CameraList* made = nullptr;
    if (gp_list_new(&made) < GP_OK) return {};
    const Names names(made);
    if (gp_camera_autodetect(names.get(), context_.get()) < GP_OK) return {};
    std::vector<GphotoCamera> cameras;
    for (int i = 0; i < gp_list_count(names.get()); ++i) {
      const char *model = nullptr, *port = nullptr;
      gp_list_get_name(names.get(), i, &model);
      gp_list_get_value(names.get(), i, &port);
      if (model != nullptr && port != nullptr) cameras.push_back({model, port});
    }
    return cameras;
  }

  void open(const GphotoCamera& wanted) override {
    close();
    const PlainLocale plain;
    CameraAbilitiesList* madeAbilities = nullptr;
    check(gp_abilities_list_new(&madeAbilities));
    const Abilities abilities(madeAbilities);
    check(gp_abilities_list_load(abilities.get(), context_.get()));
    CameraAbilities model;
    check(gp_abilities_list_get_abilities(
        abilities.get(), checked(gp_abilities_list_lookup_model(abilities.get(), wanted.model.c_str())),
        &model));

    GPPortInfoList* madePorts = nullptr;
    check(gp_port_info_list_new(&madePorts));
    const Ports ports(madePorts);
    check(gp_port_info_list_load(ports.get()));
    GPPortInfo port;
    const int place = gp_port_info_list_lookup_path(ports.get(), wanted.port.c_str());
    if (place < GP_OK || gp_port_info_list_get_info(ports.get(), place, &port) < GP_OK)
      throw GphotoFailure(GphotoFault::absent, "nothing is plugged in at " + wanted.port);

    Camera* made = nullptr;
    check(gp_camera_new(&made));
    OwnedCamera camera(made);
    check(gp_camera_set_abilities(camera.get(), model));
    check(gp_camera_set_port_info(camera.get(), port));
    const int connected = gp_camera_init(camera.get(), context_.get());
    // What the library says of a port that does not exist: it makes up an entry for every name.
    if (connected == GP_ERROR_BAD_PARAMETERS)
      throw GphotoFailure(GphotoFault::absent, "nothing is plugged in at " + wanted.port);
    check(connected);
    camera_ = std::move(camera);
  }

  void close() noexcept override {
    if (!camera_) return;
    const PlainLocale plain;
    gp_camera_exit(camera_.get(), context_.get());
    camera_.reset();
  }

  std::optional<GphotoSetting> get(const std::string& name) override {
    const PlainLocale plain;
    const Widget widget = widgetOf(name);
    if (!widget) return std::nullopt;
    GphotoSetting setting;
    setting.value = valueOf(widget.get());
    int readOnly = 0;
    gp_widget_get_readonly(widget.get(), &readOnly);
    setting.readOnly = readOnly != 0;
    for (int i = 0; i < gp_widget_count_choices(widget.get()); ++i) {
      const char* choice = nullptr;
      if (gp_widget_get_choice(widget.get(), i, &choice) >= GP_OK && choice != nullptr)
        setting.choices.emplace_back(choice);
    }
    return setting;
  }

  void set(const std::string& name, const std::string& value) override {
    const PlainLocale plain;
    const Widget widget = widgetOf(name);
    if (!widget) throw GphotoFailure(GphotoFault::refused, "it has no " + name);
    setValue(widget.get(), value);
    check(gp_camera_set_single_config(camera(), name.c_str(), widget.get(), context_.get()));
  }

  void trigger() override {
    const PlainLocale plain;
    check(gp_camera_trigger_capture(camera(), context_.get()));
  }

  Event waitEvent(microseconds time) override {
    const PlainLocale plain;
    CameraEventType type = GP_EVENT_UNKNOWN;
    void* data = nullptr;
    const int milliseconds = static_cast<int>(std::max<std::int64_t>(1, time.count() / 1000));
    check(gp_camera_wait_for_event(camera(), milliseconds, &type, &data, context_.get()));
    const std::unique_ptr<void, Releaser<std::free>> owned(data);
    Event event;
    event.timedOut = type == GP_EVENT_TIMEOUT;
    if (type == GP_EVENT_FILE_ADDED && data != nullptr) {
      const auto* path = static_cast<const CameraFilePath*>(data);
      event.file = GphotoFile{path->folder, path->name};
    }
    return event;
  }

  std::vector<std::uint8_t> download(const GphotoFile& wanted) override {
    const PlainLocale plain;
    CameraFile* made = nullptr;
    check(gp_file_new(&made));
    const File file(made);
    check(gp_camera_file_get(camera(), wanted.folder.c_str(), wanted.name.c_str(), GP_FILE_TYPE_NORMAL,
                             file.get(), context_.get()));
    const char* data = nullptr;
    unsigned long size = 0;
    check(gp_file_get_data_and_size(file.get(), &data, &size));
    return {data, data + size};
  }

  void remove(const GphotoFile& file) override {
    const PlainLocale plain;
    check(gp_camera_file_delete(camera(), file.folder.c_str(), file.name.c_str(), context_.get()));
  }

  microseconds now() const override {
    return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
  }
  void wait(microseconds time) override { std::this_thread::sleep_for(time); }

 private:
  Camera* camera() const {
    if (!camera_) throw GphotoFailure(GphotoFault::absent, "it is not connected");
    return camera_.get();
  }

  /// Throws: GphotoFailure with the camera's own words where it has said some.
  int checked(int result) {
    std::string words = std::move(said_);
    said_.clear();
    if (result >= GP_OK) return result;
    throw GphotoFailure(faultOf(result), words.empty() ? gp_result_as_string(result) : words);
  }
  void check(int result) { checked(result); }

  /// None if the camera has no such setting.
  Widget widgetOf(const std::string& name) {
    CameraWidget* widget = nullptr;
    const int result = gp_camera_get_single_config(camera(), name.c_str(), &widget, context_.get());
    if (result == GP_ERROR_BAD_PARAMETERS || result == GP_ERROR_NOT_SUPPORTED) return nullptr;
    check(result);
    return Widget(widget);
  }

  static std::string valueOf(CameraWidget* widget) {
    CameraWidgetType type = GP_WIDGET_TEXT;
    gp_widget_get_type(widget, &type);
    if (type == GP_WIDGET_TOGGLE || type == GP_WIDGET_DATE) {
      int value = 0;
      gp_widget_get_value(widget, &value);
      return fmt::format("{}", value);
    }
    if (type == GP_WIDGET_RANGE) {
      float value = 0.0f;
      gp_widget_get_value(widget, &value);
      return fmt::format("{}", value);
    }
    if (type != GP_WIDGET_TEXT && type != GP_WIDGET_RADIO && type != GP_WIDGET_MENU) return {};
    const char* value = nullptr;
    gp_widget_get_value(widget, static_cast<void*>(&value));
    return value != nullptr ? value : "";
  }

  void setValue(CameraWidget* widget, const std::string& value) {
    CameraWidgetType type = GP_WIDGET_TEXT;
    gp_widget_get_type(widget, &type);
    if (type == GP_WIDGET_TOGGLE || type == GP_WIDGET_DATE || type == GP_WIDGET_RANGE) {
      float number = 0.0f;
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
      if (error != std::errc() || end != value.data() + value.size())
        throw GphotoFailure(GphotoFault::refused, fmt::format("'{}' is no number", value));
      const int whole = static_cast<int>(std::lround(number));
      check(type == GP_WIDGET_RANGE ? gp_widget_set_value(widget, &number)
                                    : gp_widget_set_value(widget, &whole));
    } else {
      check(gp_widget_set_value(widget, value.c_str()));
    }
  }

  Context context_;
  std::string said_;
  OwnedCamera camera_;
};

}  // namespace

std::unique_ptr<GphotoPort> makeGphotoPort() {
  return std::make_unique<LibraryPort>();
}

}  // namespace relucent::devices
