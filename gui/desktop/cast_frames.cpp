// SPDX-License-Identifier: MIT
#include "desktop/cast_frames.h"

#include <pipewire/pipewire.h>
#include <spa/param/video/format-utils.h>
#include <unistd.h>

#include <QRect>
#include <array>
#include <cerrno>
#include <mutex>
#include <optional>

#include "desktop/cast_failure.h"

namespace relucent::gui {
namespace {

constexpr std::uint32_t mostSide = 16384;
constexpr int bytesPerPixel = 4;

/// Alpha, where there is one, is multiplied into the colours: without it the picture lies on black.
QImage::Format formatOf(spa_video_format format) {
  const bool isRedFirst = format == SPA_VIDEO_FORMAT_RGBx || format == SPA_VIDEO_FORMAT_RGBA;
  return isRedFirst ? QImage::Format_RGBA8888 : QImage::Format_RGB32;
}

const spa_pod* wantedFormats(spa_pod_builder& builder) {
  const spa_rectangle usual{1920, 1080}, least{1, 1}, most{mostSide, mostSide};
  const spa_fraction whenever{0, 1}, slowest{0, 1}, quickest{1000, 1};
  // NOLINTNEXTLINE: the library's macros
  return static_cast<const spa_pod*>(spa_pod_builder_add_object(
      &builder, SPA_TYPE_OBJECT_Format, SPA_PARAM_EnumFormat, SPA_FORMAT_mediaType,
      SPA_POD_Id(SPA_MEDIA_TYPE_video), SPA_FORMAT_mediaSubtype, SPA_POD_Id(SPA_MEDIA_SUBTYPE_raw),
      SPA_FORMAT_VIDEO_format,
      SPA_POD_CHOICE_ENUM_Id(5, SPA_VIDEO_FORMAT_BGRx, SPA_VIDEO_FORMAT_BGRx, SPA_VIDEO_FORMAT_BGRA,
                             SPA_VIDEO_FORMAT_RGBx, SPA_VIDEO_FORMAT_RGBA),
      SPA_FORMAT_VIDEO_size, SPA_POD_CHOICE_RANGE_Rectangle(&usual, &least, &most),
      SPA_FORMAT_VIDEO_framerate, SPA_POD_CHOICE_RANGE_Fraction(&whenever, &slowest, &quickest)));
}

const spa_pod* wantedBuffers(spa_pod_builder& builder) {
  return static_cast<const spa_pod*>(spa_pod_builder_add_object(
      &builder, SPA_TYPE_OBJECT_ParamBuffers, SPA_PARAM_Buffers, SPA_PARAM_BUFFERS_dataType,
      SPA_POD_CHOICE_FLAGS_Int((1 << SPA_DATA_MemPtr) | (1 << SPA_DATA_MemFd))));
}

/// Mutter's windows lie in buffers of the screen's size.
const spa_pod* wantedCrop(spa_pod_builder& builder) {
  return static_cast<const spa_pod*>(spa_pod_builder_add_object(
      &builder, SPA_TYPE_OBJECT_ParamMeta, SPA_PARAM_Meta, SPA_PARAM_META_type,
      SPA_POD_Id(SPA_META_VideoCrop), SPA_PARAM_META_size, SPA_POD_Int(sizeof(spa_meta_region))));
}

const spa_pod* wantedHeader(spa_pod_builder& builder) {
  return static_cast<const spa_pod*>(spa_pod_builder_add_object(
      &builder, SPA_TYPE_OBJECT_ParamMeta, SPA_PARAM_Meta, SPA_PARAM_META_type, SPA_POD_Id(SPA_META_Header),
      SPA_PARAM_META_size, SPA_POD_Int(sizeof(spa_meta_header))));
}

/// Whether it is a picture at all: some carry the pointer's place alone.
bool holdsPicture(spa_buffer& buffer) {
  if (buffer.n_datas < 1 || buffer.datas[0].chunk == nullptr) return false;
  const spa_chunk& chunk = *buffer.datas[0].chunk;
  if (chunk.size == 0 || (chunk.flags & SPA_CHUNK_FLAG_CORRUPTED) != 0) return false;
  const auto* header = static_cast<const spa_meta_header*>(
      spa_buffer_find_meta_data(&buffer, SPA_META_Header, sizeof(spa_meta_header)));
  return header == nullptr || (header->flags & SPA_META_HEADER_FLAG_CORRUPTED) == 0;
}

QRect cropOf(spa_buffer& buffer, const QRect& whole) {
  const auto* crop = static_cast<const spa_meta_region*>(
      spa_buffer_find_meta_data(&buffer, SPA_META_VideoCrop, sizeof(spa_meta_region)));
  if (crop == nullptr || !spa_meta_region_is_valid(crop)) return whole;
  const spa_region& part = crop->region;
  if (part.size.width > mostSide || part.size.height > mostSide) return whole;
  const QRect wanted(part.position.x, part.position.y, static_cast<int>(part.size.width),
                     static_cast<int>(part.size.height));
  const QRect seen = wanted.intersected(whole);
  return seen.isEmpty() ? whole : seen;
}

/// Copied: the buffer goes back.
QImage pictureIn(spa_buffer& buffer, const spa_video_info_raw& info) {
  const spa_data& data = buffer.datas[0];
  const int width = static_cast<int>(info.size.width), height = static_cast<int>(info.size.height);
  const std::int64_t line = std::int64_t{bytesPerPixel} * width;
  const std::int64_t stride = data.chunk->stride == 0 ? line : data.chunk->stride;
  const std::int64_t offset = data.chunk->offset;
  const std::int64_t needed = stride * (height - 1) + line;
  // Nothing beyond what is mapped is read, whatever the other side says.
  if (data.data == nullptr || stride < line || needed > data.chunk->size ||
      offset + needed > std::int64_t{data.maxsize})
    throw castUnusable();
  const QImage seen(static_cast<const uchar*>(data.data) + offset, width, height, stride,
                    formatOf(info.format));
  const QRect whole = seen.rect();
  const QRect crop = cropOf(buffer, whole);
  QImage picture = (crop == whole ? seen : seen.copy(crop)).convertToFormat(QImage::Format_RGBX8888);
  if (picture.isNull()) throw std::bad_alloc();
  return picture;
}

}  // namespace

class CastFrames::Impl {
 public:
  Impl(int remote, std::uint32_t node) {
    static std::once_flag once;
    std::call_once(once, [] { pw_init(nullptr, nullptr); });
    loop_.reset(pw_main_loop_new(nullptr));
    if (loop_) context_.reset(pw_context_new(pw_main_loop_get_loop(loop_.get()), nullptr, 0));
    if (!context_) {
      ::close(remote);
      throw castWithoutPipeWire();
    }
    core_.reset(pw_context_connect_fd(context_.get(), remote, nullptr, 0));
    if (!core_) throw castWithoutPipeWire();
    pw_core_add_listener(core_.get(), &coreHook_, &coreEvents, this);
    stream_.reset(pw_stream_new(
        core_.get(), "Relucent",
        pw_properties_new(PW_KEY_MEDIA_TYPE, "Video", PW_KEY_MEDIA_CATEGORY, "Capture", PW_KEY_MEDIA_ROLE,
                          "Screen", PW_KEY_NODE_DONT_RECONNECT, "true", nullptr)));
    if (!stream_) throw castWithoutPipeWire();
    pw_stream_add_listener(stream_.get(), &streamHook_, &streamEvents, this);
    std::array<std::uint8_t, 1024> memory{};
    spa_pod_builder builder = SPA_POD_BUILDER_INIT(memory.data(), static_cast<std::uint32_t>(memory.size()));
    const spa_pod* formats = wantedFormats(builder);
    const auto flags = static_cast<pw_stream_flags>(PW_STREAM_FLAG_AUTOCONNECT | PW_STREAM_FLAG_MAP_BUFFERS);
    if (pw_stream_connect(stream_.get(), PW_DIRECTION_INPUT, node, flags, &formats, 1) < 0)
      throw castWithoutPipeWire();
  }

  ~Impl() {
    // What follows is nobody's news any more.
    if (stream_) spa_hook_remove(&streamHook_);
    if (core_) spa_hook_remove(&coreHook_);
  }

  QImage next(std::chrono::milliseconds most) {
    pw_loop* loop = pw_main_loop_get_loop(loop_.get());
    pw_loop_enter(loop);
    const int done = pw_loop_iterate(loop, static_cast<int>(most.count()));
    pw_loop_leave(loop);
    if (done < 0 && done != -EINTR) throw castEnded();
    if (failure_) throw *failure_;
    return std::exchange(newest_, {});
  }

  bool isFlowing() const { return isFlowing_; }
  bool isFirstDue() const { return isFirstDue_; }

 private:
  template <typename Work>
  void noting(Work work) {
    try {
      work();
    } catch (const Error& error) {
      if (!failure_) failure_ = error;
    } catch (const std::bad_alloc&) {
      if (!failure_) failure_ = castUnusable();
    }
  }

  void change(pw_stream_state before, pw_stream_state now) {
    isFlowing_ = now == PW_STREAM_STATE_STREAMING;
    if (now == PW_STREAM_STATE_ERROR && !failure_)
      failure_ = isAgreed_ || before == PW_STREAM_STATE_STREAMING ? castEnded() : castUnusable();
    if (now == PW_STREAM_STATE_UNCONNECTED && !failure_) failure_ = castEnded();
  }

  void agree(const spa_pod* format) {
    info_ = {};
    isAgreed_ = false;
    if (format == nullptr) return;
    if (spa_format_video_raw_parse(format, &info_) < 0 || info_.size.width < 1 || info_.size.height < 1 ||
        info_.size.width > mostSide || info_.size.height > mostSide)
      throw castUnusable();
    isAgreed_ = isFirstDue_ = true;
    std::array<std::uint8_t, 1024> memory{};
    spa_pod_builder builder = SPA_POD_BUILDER_INIT(memory.data(), static_cast<std::uint32_t>(memory.size()));
    std::array<const spa_pod*, 3> params{wantedBuffers(builder), wantedCrop(builder), wantedHeader(builder)};
    pw_stream_update_params(stream_.get(), params.data(), params.size());
  }

  void take() {
    pw_buffer* newest = nullptr;
    while (pw_buffer* buffer = pw_stream_dequeue_buffer(stream_.get())) {
      const bool isNewer = holdsPicture(*buffer->buffer);
      if (pw_buffer* other = isNewer ? newest : buffer) pw_stream_queue_buffer(stream_.get(), other);
      if (isNewer) newest = buffer;
    }
    if (newest == nullptr) return;
    isFirstDue_ = false;
    noting([&] {
      if (isAgreed_) newest_ = pictureIn(*newest->buffer, info_);
    });
    pw_stream_queue_buffer(stream_.get(), newest);
  }

  template <auto destroy>
  struct Destroy {
    template <typename Thing>
    void operator()(Thing* thing) const {
      destroy(thing);
    }
  };

  using Loop = std::unique_ptr<pw_main_loop, Destroy<pw_main_loop_destroy>>;
  using Context = std::unique_ptr<pw_context, Destroy<pw_context_destroy>>;
  using Core = std::unique_ptr<pw_core, Destroy<pw_core_disconnect>>;
  using Stream = std::unique_ptr<pw_stream, Destroy<pw_stream_destroy>>;

  static Impl& of(void* data) { return *static_cast<Impl*>(data); }
  static const pw_core_events coreEvents;
  static const pw_stream_events streamEvents;

  Loop loop_;
  Context context_;
  Core core_;
  spa_hook coreHook_{}, streamHook_{};
  Stream stream_;
  spa_video_info_raw info_{};
  bool isAgreed_ = false, isFlowing_ = false, isFirstDue_ = true;
  QImage newest_;
  std::optional<Error> failure_;
};

const pw_core_events CastFrames::Impl::coreEvents = [] {
  pw_core_events events{};
  events.version = PW_VERSION_CORE_EVENTS;
  events.error = [](void* data, std::uint32_t id, int, int, const char*) {
    // Of what it holds, the stream tells.
    if (id == PW_ID_CORE && !of(data).failure_) of(data).failure_ = castEnded();
  };
  return events;
}();

const pw_stream_events CastFrames::Impl::streamEvents = [] {
  pw_stream_events events{};
  events.version = PW_VERSION_STREAM_EVENTS;
  events.state_changed = [](void* data, pw_stream_state before, pw_stream_state now, const char*) {
    of(data).change(before, now);
  };
  events.param_changed = [](void* data, std::uint32_t id, const spa_pod* param) {
    if (id == SPA_PARAM_Format) of(data).noting([&] { of(data).agree(param); });
  };
  events.process = [](void* data) { of(data).take(); };
  return events;
}();

CastFrames::CastFrames(int remote, std::uint32_t node) : impl_(std::make_unique<Impl>(remote, node)) {}

CastFrames::~CastFrames() = default;

QImage CastFrames::next(std::chrono::milliseconds most) {
  return impl_->next(most);
}

bool CastFrames::isFlowing() const {
  return impl_->isFlowing();
}

bool CastFrames::isFirstDue() const {
  return impl_->isFirstDue();
}

QString castLibraryVersion() {
  return pw_get_library_version();
}

}  // namespace relucent::gui
