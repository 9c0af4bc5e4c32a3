// SPDX-License-Identifier: MIT
#include "support/desktop_double.h"

#include <pipewire/pipewire.h>
#include <spa/param/video/format-utils.h>

#include <QDBusArgument>
#include <QDBusConnectionInterface>
#include <QDBusMetaType>
#include <QDBusObjectPath>
#include <QDBusVariant>
#include <QTest>
#include <array>
#include <optional>
#include <utility>

namespace relucent::test {

/// As they go over the bus: (ua{sv}), and what is remembered of a choice, (suv).
struct CastStream {
  quint32 node = 0;
  QVariantMap properties;
};
struct CastChoice {
  QString vendor = "test";
  quint32 version = 1;
  QDBusVariant data = QDBusVariant(QString("the second screen"));
};

QDBusArgument& operator<<(QDBusArgument& argument, const CastStream& stream) {
  argument.beginStructure();
  argument << stream.node << stream.properties;
  argument.endStructure();
  return argument;
}
const QDBusArgument& operator>>(const QDBusArgument& argument, CastStream& stream) {
  argument.beginStructure();
  argument >> stream.node >> stream.properties;
  argument.endStructure();
  return argument;
}
QDBusArgument& operator<<(QDBusArgument& argument, const CastChoice& choice) {
  argument.beginStructure();
  argument << choice.vendor << choice.version << choice.data;
  argument.endStructure();
  return argument;
}
const QDBusArgument& operator>>(const QDBusArgument& argument, CastChoice& choice) {
  argument.beginStructure();
  argument >> choice.vendor >> choice.version >> choice.data;
  argument.endStructure();
  return argument;
}

}  // namespace relucent::test

Q_DECLARE_METATYPE(relucent::test::CastStream)
Q_DECLARE_METATYPE(relucent::test::CastChoice)

namespace relucent::test {
namespace {

constexpr int bytesPerPixel = 4;

spa_video_format formatOf(PictureNode::Order order) {
  using Order = PictureNode::Order;
  switch (order) {
    case Order::bgrx:
      return SPA_VIDEO_FORMAT_BGRx;
    case Order::bgra:
      return SPA_VIDEO_FORMAT_BGRA;
    case Order::rgbx:
      return SPA_VIDEO_FORMAT_RGBx;
    case Order::rgba:
      return SPA_VIDEO_FORMAT_RGBA;
  }
  return SPA_VIDEO_FORMAT_UNKNOWN;
}

}  // namespace

class PictureNode::Impl {
 public:
  Impl(const QImage& picture, Order order, Lie lie, int unheard)
      : picture_(picture), order_(order), lie_(lie), unheard_(unheard) {
    pw_init(nullptr, nullptr);
    loop_ = pw_thread_loop_new("pictures", nullptr);
    context_ = pw_context_new(pw_thread_loop_get_loop(loop_), nullptr, 0);
    pw_thread_loop_start(loop_);
    pw_thread_loop_lock(loop_);
    core_ = pw_context_connect(context_, nullptr, 0);
    stream_ =
        pw_stream_new(core_, "pictures", pw_properties_new(PW_KEY_MEDIA_CLASS, "Video/Source", nullptr));
    static const pw_stream_events events = [] {
      pw_stream_events made{};
      made.version = PW_VERSION_STREAM_EVENTS;
      made.state_changed = [](void* data, pw_stream_state, pw_stream_state now, const char*) {
        auto& self = *static_cast<Impl*>(data);
        self.streams_ = now == PW_STREAM_STATE_STREAMING;
        // As compositors do, whether anybody hears it or not.
        if (self.streams_) self.isDue_ = self.unheard_-- <= 0;
      };
      made.param_changed = [](void* data, std::uint32_t id, const spa_pod* param) {
        if (id == SPA_PARAM_Format && param != nullptr) static_cast<Impl*>(data)->allot(param);
      };
      return made;
    }();
    pw_stream_add_listener(stream_, &hook_, &events, this);
    std::array<std::uint8_t, 1024> memory{};
    const spa_pod* format = offered(memory);
    pw_stream_connect(stream_, PW_DIRECTION_OUTPUT, PW_ID_ANY,
                      static_cast<pw_stream_flags>(PW_STREAM_FLAG_DRIVER | PW_STREAM_FLAG_MAP_BUFFERS),
                      &format, 1);
    timer_ = pw_loop_add_timer(
        pw_thread_loop_get_loop(loop_), [](void* data, std::uint64_t) { static_cast<Impl*>(data)->send(); },
        this);
    timespec soon{0, 5'000'000};
    pw_loop_update_timer(pw_thread_loop_get_loop(loop_), timer_, &soon, &soon, false);
    pw_thread_loop_unlock(loop_);
  }

  ~Impl() {
    pw_thread_loop_lock(loop_);
    pw_loop_destroy_source(pw_thread_loop_get_loop(loop_), timer_);
    spa_hook_remove(&hook_);
    pw_stream_destroy(stream_);
    pw_core_disconnect(core_);
    pw_thread_loop_unlock(loop_);
    pw_thread_loop_stop(loop_);
    pw_context_destroy(context_);
    pw_thread_loop_destroy(loop_);
  }

  quint32 number() {
    pw_thread_loop_lock(loop_);
    const quint32 node = pw_stream_get_node_id(stream_);
    pw_thread_loop_unlock(loop_);
    return node;
  }

  void show(const QImage& picture, std::optional<Order> order, bool isHeard = true) {
    pw_thread_loop_lock(loop_);
    const bool isOther = picture.size() != picture_.size() || (order && *order != order_);
    picture_ = picture;
    if (order) order_ = *order;
    isDue_ = isHeard;
    if (isOther) {
      isAllotted_ = false;
      std::array<std::uint8_t, 1024> memory{};
      const spa_pod* format = offered(memory);
      pw_stream_update_params(stream_, &format, 1);
    }
    pw_thread_loop_unlock(loop_);
  }

  void tell(Lie lie) {
    pw_thread_loop_lock(loop_);
    lie_ = lie;
    isDue_ = true;
    pw_thread_loop_unlock(loop_);
  }

 private:
  const spa_pod* offered(std::array<std::uint8_t, 1024>& memory) {
    spa_pod_builder builder = SPA_POD_BUILDER_INIT(memory.data(), static_cast<std::uint32_t>(memory.size()));
    const spa_rectangle size{static_cast<std::uint32_t>(picture_.width()),
                             static_cast<std::uint32_t>(picture_.height())};
    const spa_fraction whenever{0, 1};
    const spa_video_format format = lie_ == Lie::strangeFormat ? SPA_VIDEO_FORMAT_YUY2 : formatOf(order_);
    return static_cast<const spa_pod*>(spa_pod_builder_add_object(
        &builder, SPA_TYPE_OBJECT_Format, SPA_PARAM_EnumFormat, SPA_FORMAT_mediaType,
        SPA_POD_Id(SPA_MEDIA_TYPE_video), SPA_FORMAT_mediaSubtype, SPA_POD_Id(SPA_MEDIA_SUBTYPE_raw),
        SPA_FORMAT_VIDEO_format, SPA_POD_Id(format), SPA_FORMAT_VIDEO_size, SPA_POD_Rectangle(&size),
        SPA_FORMAT_VIDEO_framerate, SPA_POD_Fraction(&whenever)));
  }

  int stride() const { return bytesPerPixel * picture_.width() + 32; }  // lines end apart

  void allot(const spa_pod* agreed) {
    spa_video_info_raw info{};
    spa_format_video_raw_parse(agreed, &info);
    // What was agreed on before the last change is of no use any more.
    isAllotted_ =
        QSize(static_cast<int>(info.size.width), static_cast<int>(info.size.height)) == picture_.size() &&
        info.format == formatOf(order_);
    std::array<std::uint8_t, 1024> memory{};
    spa_pod_builder builder = SPA_POD_BUILDER_INIT(memory.data(), static_cast<std::uint32_t>(memory.size()));
    const auto* buffers = static_cast<const spa_pod*>(spa_pod_builder_add_object(
        &builder, SPA_TYPE_OBJECT_ParamBuffers, SPA_PARAM_Buffers, SPA_PARAM_BUFFERS_buffers,
        SPA_POD_CHOICE_RANGE_Int(4, 2, 8), SPA_PARAM_BUFFERS_blocks, SPA_POD_Int(1), SPA_PARAM_BUFFERS_size,
        SPA_POD_Int(stride() * picture_.height()), SPA_PARAM_BUFFERS_stride, SPA_POD_Int(stride()),
        SPA_PARAM_BUFFERS_dataType, SPA_POD_CHOICE_FLAGS_Int(1 << SPA_DATA_MemFd)));
    pw_stream_update_params(stream_, &buffers, 1);
  }

  void send() {
    if (!isDue_ || !streams_ || !isAllotted_) return;
    pw_buffer* buffer = pw_stream_dequeue_buffer(stream_);
    if (buffer == nullptr) return;
    spa_data& data = buffer->buffer->datas[0];
    const bool isRedFirst = order_ == Order::rgbx || order_ == Order::rgba;
    const bool hasRoom =
        data.data != nullptr && data.maxsize >= static_cast<std::uint32_t>(stride() * picture_.height());
    for (int y = 0; hasRoom && y < picture_.height(); ++y) {
      auto* line = static_cast<std::uint8_t*>(data.data) + std::ptrdiff_t{stride()} * y;
      for (int x = 0; x < picture_.width(); ++x) {
        const QRgb pixel = picture_.pixel(x, y);
        std::uint8_t* bytes = line + std::ptrdiff_t{bytesPerPixel} * x;
        bytes[isRedFirst ? 0 : 2] = static_cast<std::uint8_t>(qRed(pixel));
        bytes[1] = static_cast<std::uint8_t>(qGreen(pixel));
        bytes[isRedFirst ? 2 : 0] = static_cast<std::uint8_t>(qBlue(pixel));
        bytes[3] = static_cast<std::uint8_t>(x);  // whatever: it means nothing, or lies on black
      }
    }
    spa_chunk& chunk = *data.chunk;
    chunk.offset = 0;
    chunk.stride = stride();
    chunk.size = static_cast<std::uint32_t>(stride() * picture_.height());
    if (lie_ == Lie::shortData) chunk.size /= 2;
    if (lie_ == Lie::longLines) chunk.stride = 1 << 30;
    if (lie_ == Lie::backwardLines) chunk.stride = -stride();
    if (lie_ == Lie::beyondEnd) chunk.offset = data.maxsize - 4;
    pw_stream_queue_buffer(stream_, buffer);
    isDue_ = false;
  }

  QImage picture_;
  Order order_;
  Lie lie_;
  int unheard_;
  pw_thread_loop* loop_ = nullptr;
  pw_context* context_ = nullptr;
  pw_core* core_ = nullptr;
  pw_stream* stream_ = nullptr;
  spa_source* timer_ = nullptr;
  spa_hook hook_{};
  bool streams_ = false, isAllotted_ = false, isDue_ = false;
};

PictureNode::PictureNode(const QImage& picture, Order order, Lie lie, int unheard)
    : impl_(std::make_unique<Impl>(picture, order, lie, unheard)) {}

PictureNode::~PictureNode() = default;

quint32 PictureNode::number() const {
  quint32 node = PW_ID_ANY;
  [[maybe_unused]] const bool known =
      QTest::qWaitFor([&] { return (node = impl_->number()) != PW_ID_ANY; }, 10'000);
  return node;
}

void PictureNode::show(const QImage& picture) {
  impl_->show(picture, std::nullopt);
}

void PictureNode::show(const QImage& picture, Order order) {
  impl_->show(picture, order);
}

void PictureNode::showUnheard(const QImage& picture) {
  impl_->show(picture, std::nullopt, false);
}

void PictureNode::tell(Lie lie) {
  impl_->tell(lie);
}

namespace {

constexpr const char* root = "/org/freedesktop/portal/desktop";
constexpr const char* casting = "org.freedesktop.impl.portal.ScreenCast";
constexpr uint given = 0, refused = 1, ended = 2;
constexpr uint screensAndWindows = 3;

QVariantMap mapIn(const QVariant& value) {
  return qdbus_cast<QVariantMap>(value);
}

}  // namespace

DesktopDouble::DesktopDouble() : bus_(QDBusConnection::sessionBus()) {
  qDBusRegisterMetaType<CastStream>();
  qDBusRegisterMetaType<QList<CastStream>>();
  qDBusRegisterMetaType<CastChoice>();
  bus_.registerVirtualObject(root, this, QDBusConnection::SubPath);
  bus_.registerService("org.freedesktop.impl.portal.desktop.test");
  portal_.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  portal_.start(qEnvironmentVariable("PORTAL_PROGRAM"), QStringList());
  [[maybe_unused]] const bool stands = QTest::qWaitFor(
      [this] { return bus_.interface()->isServiceRegistered("org.freedesktop.portal.Desktop"); }, 20'000);
}

DesktopDouble::~DesktopDouble() {
  portal_.terminate();
  if (!portal_.waitForFinished(5'000)) portal_.kill();
  portal_.waitForFinished();
  bus_.unregisterService("org.freedesktop.impl.portal.desktop.test");
  bus_.unregisterObject(root, QDBusConnection::UnregisterTree);
}

void DesktopDouble::endAll() {
  for (const QString& session : std::exchange(sessions_, {}))
    bus_.send(QDBusMessage::createSignal(session, "org.freedesktop.impl.portal.Session", "Closed"));
}

QString DesktopDouble::introspect(const QString&) const {
  return {};
}

bool DesktopDouble::handleMessage(const QDBusMessage& message, const QDBusConnection& connection) {
  const QVariantList said = message.arguments();
  const QString method = message.member();
  const auto reply = [&](const QVariantList& arguments) {
    return connection.send(message.createReply(arguments));
  };
  if (message.interface() == "org.freedesktop.DBus.Properties") {
    const QVariantMap properties{
        {"AvailableSourceTypes", screensAndWindows}, {"AvailableCursorModes", 1u}, {"version", 4u}};
    if (method == "GetAll") return reply({properties});
    return reply({QVariant::fromValue(QDBusVariant(properties.value(said.value(1).toString())))});
  }
  if (method == "Close") {
    if (open_.remove(message.path()) > 0) ++withdrawn;
    sessions_.removeAll(message.path());
    return reply({});
  }
  if (message.interface() != casting) return false;
  const QString session = said.value(1).value<QDBusObjectPath>().path();
  if (method == "CreateSession") {
    sessions_.append(session);
    return reply({given, QVariantMap()});
  }
  if (method == "SelectSources") {
    const QVariantMap options = mapIn(said.value(3));
    wanted.push_back(options.value("types").toUInt());
    restored_[session] = options.contains("restore_data") && takesChoicesAgain;
    return reply({given, QVariantMap()});
  }
  if (method != "Start") return false;
  if (!restored_.value(session)) {
    ++questions;
    if (answer == Answer::refuses) return reply({refused, QVariantMap()});
    if (answer == Answer::fails) return reply({ended, QVariantMap()});
    if (answer == Answer::waits) {
      open_[said.value(0).value<QDBusObjectPath>().path()] = message;
      message.setDelayedReply(true);
      return true;
    }
  }
  QVariantMap results{{"streams", QVariant::fromValue(QList<CastStream>{{node, {}}})}};
  if (remembers) {
    results["persist_mode"] = 2u;
    results["restore_data"] = QVariant::fromValue(CastChoice());
  }
  return reply({given, results});
}

}  // namespace relucent::test
