// SPDX-License-Identifier: MIT
#include "content/stream_decoder.h"

#include <QHostAddress>
#include <QHostInfo>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

#include "content/stream_failure.h"
#include "content/stream_picture.h"
#include "content/stream_turn.h"
#include "relucent/base/progress.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
}

namespace relucent::gui {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::size_t mostInside = 64;                       // packets within the decoder
constexpr std::int64_t largest = std::int64_t{8192} * 8192;  // pixels: no canvas is larger
// What is read before it is decided what it is: more is longer in coming.
constexpr const char* analysed = "1000000";  // microseconds
// All are protocols of the network: an answer that names a file of this computer opens nothing.
constexpr const char* protocols = "rtsp,rtp,srtp,udp,tcp,tls,http,https,httpproxy,srt,rtmp,rtmps,crypto";

void prepareFfmpeg() {
  static std::once_flag once;
  std::call_once(once, [] {
    // It would write addresses to standard error, with their passwords.
    av_log_set_level(AV_LOG_QUIET);
    avformat_network_init();
  });
}

/// When the sender sent it, by its clock, in microseconds since 1970.
std::optional<std::int64_t> sentAt(const AVPacket& packet) {
  std::size_t size = 0;
  const std::uint8_t* data = av_packet_get_side_data(&packet, AV_PKT_DATA_PRFT, &size);
  if (data == nullptr || size < sizeof(AVProducerReferenceTime)) return std::nullopt;
  return reinterpret_cast<const AVProducerReferenceTime*>(data)->wallclock;
}

}  // namespace

class StreamDecoder::Impl {
 public:
  Impl(const StreamAddress& address, const StreamPatience& patience, IsUnwanted isUnwanted)
      : patience_(patience),
        isUnwanted_(std::move(isUnwanted)),
        packet_(av_packet_alloc()),
        frame_(av_frame_alloc()) {
    if (!packet_ || !frame_) throw std::bad_alloc();
    prepareFfmpeg();
    wait(patience_.opening);
    lookUp(address.host);
    waitForTurn(address.url);
    openInput(address.url.toUtf8());
    openCodec();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  LivePicture next() {
    for (;;) {
      check();
      const int got = avcodec_receive_frame(codec_.get(), frame_.get());
      if (got == AVERROR(ENOMEM)) throw std::bad_alloc();
      if (got == 0) break;
      feed();
    }
    LivePicture picture = arrivalOf(*frame_);
    if (isPaced_) keepTime(*frame_);
    picture.image = pictureOf(*frame_, codec_->codec_id == AV_CODEC_ID_MJPEG);
    av_frame_unref(frame_.get());
    hasPlayed_ = true;
    wait(patience_.stalled);
    return picture;
  }

 private:
  struct FreePacket {
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  };
  struct FreeFrame {
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  };
  struct FreeCodec {
    void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  };
  struct CloseInput {
    void operator()(AVFormatContext* input) const { avformat_close_input(&input); }
  };

  bool isOver() const { return isUnwanted_() || Clock::now() >= deadline_; }

  void wait(std::chrono::milliseconds patience) {
    waited_ = patience;
    deadline_ = Clock::now() + patience;
  }

  /// What is interrupted is so for a reason that only this side knows.
  void check() const {
    if (isUnwanted_()) throw Cancelled();
    if (Clock::now() >= deadline_)
      throw streamSilent(std::chrono::duration<double>(waited_).count(), hasPlayed_);
  }
  void demand(int code) const {
    if (code >= 0) return;
    check();
    // A server that goes in the middle of a picture.
    throw streamFailure(code == AVERROR(EIO) && hasPlayed_ ? AVERROR_EOF : code);
  }

  /// FFmpeg does not tell a name that is unknown from other failures.
  void lookUp(const QString& host) const {
    if (host.isEmpty() || !QHostAddress(host).isNull()) return;
    const bool isKnown = !QHostInfo::fromName(host).addresses().isEmpty();
    check();
    if (!isKnown) throw streamHostUnknown();
  }

  void waitForTurn(const QString& url) {
    turn_.emplace(url, [this] {
      if (isUnwanted_()) throw Cancelled();
      if (isOver()) throw streamOpenAlready();
    });
    wait(waited_);
  }

  void openInput(const QByteArray& url) {
    AVFormatContext* opening = avformat_alloc_context();
    if (opening == nullptr) throw std::bad_alloc();
    opening->interrupt_callback = {
        [](void* self) { return static_cast<int>(static_cast<Impl*>(self)->isOver()); }, this};
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", protocols, 0);
    av_dict_set(&options, "analyzeduration", analysed, 0);
    av_dict_set(&options, "rtsp_flags", "prefer_tcp", 0);  // which loses nothing
    const int opened =
        avformat_open_input(&opening, url.constData(), nullptr, &options);  // freed if it fails
    av_dict_free(&options);
    demand(opened);
    input_.reset(opening);
    demand(avformat_find_stream_info(input_.get(), nullptr));
    // What has an end, or comes in pieces of several seconds, comes faster than it is to be seen.
    const std::string_view kind = input_->iformat->name;
    const bool hasSize = input_->pb != nullptr && avio_size(input_->pb) > 0;
    isPaced_ = hasSize || input_->duration > 0 || kind == "hls" || kind == "dash";
  }

  void openCodec() {
    const AVCodec* known = nullptr;
    for (unsigned i = 0; i < input_->nb_streams; ++i) {
      AVStream* stream = input_->streams[i];
      const AVCodec* codec = stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && known == nullptr
                                 ? avcodec_find_decoder(stream->codecpar->codec_id)
                                 : nullptr;
      if (codec == nullptr) {
        stream->discard = AVDISCARD_ALL;
        continue;
      }
      known = codec;
      stream_ = stream;
    }
    if (known == nullptr) {
      check();
      throw streamUnusable();
    }
    codec_.reset(avcodec_alloc_context3(known));
    if (!codec_) throw std::bad_alloc();
    demand(avcodec_parameters_to_context(codec_.get(), stream_->codecpar));
    codec_->pkt_timebase = stream_->time_base;
    codec_->max_pixels = largest;
    // Frame by frame on several threads would give each picture later.
    codec_->thread_type = FF_THREAD_SLICE;
    codec_->thread_count = 0;
    demand(avcodec_open2(codec_.get(), known, nullptr));
  }

  /// One more packet to the decoder. What is damaged is left out: the patience decides how long.
  void feed() {
    const int got = av_read_frame(input_.get(), packet_.get());
    if (got == AVERROR(EAGAIN)) {
      std::this_thread::sleep_for(5ms);
      return;
    }
    demand(got);
    if (packet_->stream_index == stream_->index) {
      last_ = {{}, Clock::now(), std::nullopt};
      if (const std::optional<std::int64_t> sent = sentAt(*packet_)) {
        using namespace std::chrono;
        const auto now = duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
        last_.senderSeconds = 1e-6 * static_cast<double>(now - *sent);
      }
      if (packet_->pts != AV_NOPTS_VALUE) {
        if (inside_.size() >= mostInside) inside_.erase(inside_.begin());
        inside_[packet_->pts] = last_;
      }
      if (avcodec_send_packet(codec_.get(), packet_.get()) == AVERROR(ENOMEM)) throw std::bad_alloc();
    }
    av_packet_unref(packet_.get());
  }

  /// Decoders give pictures in another order than packets.
  LivePicture arrivalOf(const AVFrame& frame) {
    const auto found = inside_.find(frame.pts);
    const LivePicture arrival = found != inside_.end() ? found->second : last_;
    if (found != inside_.end()) inside_.erase(found);
    return arrival;
  }

  /// Waits until the picture is due. One that is late by more than a moment begins the time anew.
  void keepTime(const AVFrame& frame) {
    if (frame.best_effort_timestamp == AV_NOPTS_VALUE) return;
    const std::chrono::duration<double> own(static_cast<double>(frame.best_effort_timestamp) *
                                            av_q2d(stream_->time_base));
    const auto place = std::chrono::duration_cast<Clock::duration>(own);
    constexpr Clock::duration moment = 500ms, most = 10s;
    const Clock::time_point now = Clock::now();
    if (!begun_ || now - (*begun_ + place) > moment || *begun_ + place - now > most) begun_ = now - place;
    // Nothing is waited for of the sender meanwhile.
    deadline_ += std::max(Clock::duration{0}, *begun_ + place - now);
    while (Clock::now() < *begun_ + place) {
      check();
      std::this_thread::sleep_for(std::min<Clock::duration>(*begun_ + place - Clock::now(), 10ms));
    }
  }

  StreamPatience patience_;
  IsUnwanted isUnwanted_;
  std::optional<StreamTurn> turn_;  // ends after what it was for
  std::unique_ptr<AVFormatContext, CloseInput> input_;
  std::unique_ptr<AVCodecContext, FreeCodec> codec_;
  std::unique_ptr<AVPacket, FreePacket> packet_;
  std::unique_ptr<AVFrame, FreeFrame> frame_;
  AVStream* stream_ = nullptr;  // of the input
  bool isPaced_ = false, hasPlayed_ = false;
  Clock::time_point deadline_;
  std::chrono::milliseconds waited_{0};
  LivePicture last_;                            // without its picture: the newest packet
  std::map<std::int64_t, LivePicture> inside_;  // likewise, by time stamp
  std::optional<Clock::time_point> begun_;      // when the stream's own time was 0
};

StreamDecoder::StreamDecoder(const StreamAddress& address, const StreamPatience& patience,
                             IsUnwanted isUnwanted)
    : impl_(std::make_unique<Impl>(address, patience, std::move(isUnwanted))) {}

StreamDecoder::~StreamDecoder() = default;

LivePicture StreamDecoder::next() {
  return impl_->next();
}

QString streamLibraryVersion() {
  const unsigned version = avformat_version();
  return QString("%1.%2.%3")
      .arg(AV_VERSION_MAJOR(version))
      .arg(AV_VERSION_MINOR(version))
      .arg(AV_VERSION_MICRO(version));
}

}  // namespace relucent::gui
