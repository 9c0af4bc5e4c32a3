// SPDX-License-Identifier: MIT
#include "support/screencopy.h"

#include <sys/mman.h>
#include <unistd.h>
#include <wayland-client.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <memory>
#include <string_view>

namespace relucent::tests {
namespace {

// The protocol's first version.
extern const wl_interface frameInterface;
const wl_interface* captured[] = {&frameInterface, nullptr, &wl_output_interface};
const wl_interface* copied[] = {&wl_buffer_interface};
const wl_interface* numbers[] = {nullptr, nullptr, nullptr, nullptr};
const wl_message managerRequests[] = {{"capture_output", "nio", captured}};
const wl_interface managerInterface{"zwlr_screencopy_manager_v1", 1, 1, managerRequests, 0, nullptr};
const wl_message frameRequests[] = {{"copy", "o", copied}, {"destroy", "", numbers}};
const wl_message frameEvents[] = {
    {"buffer", "uuuu", numbers}, {"flags", "u", numbers}, {"ready", "uuu", numbers}, {"failed", "", numbers}};
const wl_interface frameInterface{"zwlr_screencopy_frame_v1", 1, 2, frameRequests, 4, frameEvents};
constexpr std::uint32_t captureOutput = 0, copy = 0, destroy = 1, upsideDown = 1;

struct Output {
  wl_output* proxy = nullptr;
  std::string name;
};

struct Client {
  wl_shm* memory = nullptr;
  wl_proxy* manager = nullptr;
  std::vector<std::unique_ptr<Output>> outputs;
};

struct Frame {
  std::uint32_t format = 0, width = 0, height = 0, stride = 0;
  bool isUpsideDown = false, isDone = false, failed = false;
};

struct FrameListener {
  void (*buffer)(void*, wl_proxy*, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t);
  void (*flags)(void*, wl_proxy*, std::uint32_t);
  void (*ready)(void*, wl_proxy*, std::uint32_t, std::uint32_t, std::uint32_t);
  void (*failed)(void*, wl_proxy*);
};

const FrameListener frameListener{
    .buffer =
        [](void* data, wl_proxy*, std::uint32_t format, std::uint32_t width, std::uint32_t height,
           std::uint32_t stride) {
          auto& frame = *static_cast<Frame*>(data);
          frame = {format, width, height, stride};
        },
    .flags = [](void* data, wl_proxy*,
                std::uint32_t flags) { static_cast<Frame*>(data)->isUpsideDown = (flags & upsideDown) != 0; },
    .ready = [](void* data, wl_proxy*, std::uint32_t, std::uint32_t,
                std::uint32_t) { static_cast<Frame*>(data)->isDone = true; },
    .failed = [](void* data, wl_proxy*) { static_cast<Frame*>(data)->failed = true; },
};

const wl_output_listener outputListener{
    .geometry = [](void*, wl_output*, int, int, int, int, int, const char*, const char*, int) {},
    .mode = [](void*, wl_output*, std::uint32_t, int, int, int) {},
    .done = [](void*, wl_output*) {},
    .scale = [](void*, wl_output*, int) {},
    .name = [](void* data, wl_output*, const char* name) { static_cast<Output*>(data)->name = name; },
    .description = [](void*, wl_output*, const char*) {},
};

const wl_registry_listener registryListener{
    .global =
        [](void* data, wl_registry* registry, std::uint32_t global, const char* name, std::uint32_t) {
          auto& client = *static_cast<Client*>(data);
          const std::string_view kind = name;
          if (kind == wl_shm_interface.name)
            client.memory = static_cast<wl_shm*>(wl_registry_bind(registry, global, &wl_shm_interface, 1));
          if (kind == managerInterface.name)
            client.manager = static_cast<wl_proxy*>(wl_registry_bind(registry, global, &managerInterface, 1));
          if (kind != wl_output_interface.name) return;
          Output& output = *client.outputs.emplace_back(std::make_unique<Output>());
          output.proxy = static_cast<wl_output*>(wl_registry_bind(registry, global, &wl_output_interface, 4));
          wl_output_add_listener(output.proxy, &outputListener, &output);
        },
    .global_remove = [](void*, wl_registry*, std::uint32_t) {},
};

struct Disconnect {
  void operator()(wl_display* display) const { wl_display_disconnect(display); }
};

/// Its alpha, if it has one, left out.
OutputPicture pictureFrom(const Frame& frame, const std::byte* bytes) {
  OutputPicture picture{static_cast<int>(frame.width), static_cast<int>(frame.height), {}};
  picture.pixels.resize(std::size_t{frame.width} * frame.height);
  const bool isRedLast = frame.format == WL_SHM_FORMAT_XBGR8888 || frame.format == WL_SHM_FORMAT_ABGR8888;
  for (std::uint32_t y = 0; y < frame.height; ++y) {
    const std::uint32_t from = frame.isUpsideDown ? frame.height - 1 - y : y;
    std::uint32_t* line = picture.pixels.data() + std::size_t{y} * frame.width;
    std::memcpy(line, bytes + std::size_t{from} * frame.stride, 4 * std::size_t{frame.width});
    for (std::uint32_t x = 0; x < frame.width; ++x) {
      if (isRedLast) line[x] = (line[x] & 0xff00u) | (line[x] & 0xffu) << 16 | (line[x] >> 16 & 0xffu);
      line[x] |= 0xff000000u;
    }
  }
  return picture;
}

}  // namespace

OutputPicture pictureOfOutput(const std::string& name) {
  const std::unique_ptr<wl_display, Disconnect> display(wl_display_connect(nullptr));
  if (!display) return {};
  Client client;
  wl_registry* registry = wl_display_get_registry(display.get());
  wl_registry_add_listener(registry, &registryListener, &client);
  for (int trip = 0; trip < 2; ++trip) wl_display_roundtrip(display.get());
  const auto output = std::find_if(client.outputs.begin(), client.outputs.end(),
                                   [&](const auto& present) { return present->name == name; });
  if (client.manager == nullptr || client.memory == nullptr || output == client.outputs.end()) return {};

  Frame frame;
  wl_proxy* copying = wl_proxy_marshal_flags(client.manager, captureOutput, &frameInterface, 1, 0, nullptr, 0,
                                             (*output)->proxy);
  wl_proxy_add_listener(
      copying, reinterpret_cast<void (**)(void)>(const_cast<FrameListener*>(&frameListener)), &frame);
  while (frame.stride == 0 && !frame.failed)
    if (wl_display_roundtrip(display.get()) < 0) return {};
  if (frame.failed) return {};

  const std::size_t bytes = std::size_t{frame.stride} * frame.height;
  const int file = memfd_create("output", 0);
  if (file < 0 || ftruncate(file, static_cast<off_t>(bytes)) != 0) return {};
  void* shared = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  wl_shm_pool* pool = wl_shm_create_pool(client.memory, file, static_cast<std::int32_t>(bytes));
  wl_buffer* buffer = wl_shm_pool_create_buffer(pool, 0, static_cast<std::int32_t>(frame.width),
                                                static_cast<std::int32_t>(frame.height),
                                                static_cast<std::int32_t>(frame.stride), frame.format);
  wl_proxy_marshal_flags(copying, copy, nullptr, 1, 0, buffer);
  while (!frame.isDone && !frame.failed && wl_display_dispatch(display.get()) >= 0) continue;
  OutputPicture picture;
  if (frame.isDone) picture = pictureFrom(frame, static_cast<const std::byte*>(shared));
  munmap(shared, bytes);
  close(file);
  return picture;
}

}  // namespace relucent::tests
