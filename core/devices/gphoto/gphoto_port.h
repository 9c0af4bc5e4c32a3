// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace relucent::devices {

/// How a call to a still camera failed, as far as the answers differ.
enum class GphotoFault {
  absent,   // no such camera is connected
  claimed,  // somebody else holds it, mostly the desktop
  silent,   // it does not answer, or no longer
  busy,     // not now
  full,     // no room for a photograph
  refused,  // it cannot or will not; its own words say why
};

class GphotoFailure : public std::exception {
 public:
  /// `words`: the library's or the camera's own.
  GphotoFailure(GphotoFault fault, std::string words) : fault_(fault), words_(std::move(words)) {}
  GphotoFault fault() const { return fault_; }
  const char* what() const noexcept override { return words_.c_str(); }

 private:
  GphotoFault fault_;
  std::string words_;
};

/// One of a camera's settings. Switches are "0" and "1", numbers are written with a point.
struct GphotoSetting {
  std::string value;
  std::vector<std::string> choices{};  // none: any value
  bool readOnly = false;
};

/// A file in the camera.
struct GphotoFile {
  std::string folder, name;
  bool operator==(const GphotoFile&) const = default;
};

/// A camera that is plugged in.
struct GphotoCamera {
  std::string model;  // "Canon EOS 80D"
  std::string port;   // "usb:001,005"
};

/// A still camera as libgphoto2 speaks to it, as narrow as can be: what a test can put a script behind. In
/// English and with points in numbers, whatever the user's language is.
/// All but list(), close(), now() and wait() throw GphotoFailure.
class GphotoPort {
 public:
  virtual ~GphotoPort() = default;

  virtual std::vector<GphotoCamera> list() = 0;
  virtual void open(const GphotoCamera& camera) = 0;
  virtual void close() noexcept = 0;

  /// None if the camera has no such setting.
  virtual std::optional<GphotoSetting> get(const std::string& setting) = 0;
  virtual void set(const std::string& setting, const std::string& value) = 0;

  virtual void trigger() = 0;
  /// What the camera says next within `time`: a file that it has made, or nothing of interest.
  struct Event {
    std::optional<GphotoFile> file{};
    bool timedOut = false;  // it said nothing at all
  };
  virtual Event waitEvent(std::chrono::microseconds time) = 0;
  virtual std::vector<std::uint8_t> download(const GphotoFile& file) = 0;
  virtual void remove(const GphotoFile& file) = 0;

  virtual std::chrono::microseconds now() const = 0;
  virtual void wait(std::chrono::microseconds time) = 0;
};

std::unique_ptr<GphotoPort> makeGphotoPort();

}  // namespace relucent::devices
