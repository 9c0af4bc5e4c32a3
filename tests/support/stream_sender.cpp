// SPDX-License-Identifier: MIT
#include "support/stream_sender.h"

#include <QBuffer>
#include <QDateTime>
#include <QImage>
#include <QtEndian>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace relucent::test {
namespace {

constexpr int interval = 40;  // milliseconds
constexpr int perDatagram = 7 * 188;
constexpr quint32 ticks = 90'000 / 25;  // of RTP's clock, a picture

void demand(bool holds) {
  if (!holds) qFatal("FFmpeg cannot make the test's stream");
}

QByteArray bigEndian(quint32 value, int bytes = 4) {
  QByteArray text(4, 0);
  qToBigEndian(value, text.data());
  return text.right(bytes);
}

constexpr quint32 transportStream = 33, mpegVideo = 32;  // RTP's payload types, RFC 3551

QByteArray rtpPacket(quint32 kind, const QByteArray& content, quint16 sequence, quint32 time,
                     bool isLast = false) {
  const quint32 marked = isLast ? 0x80u : 0u;
  return bigEndian(0x80000000u | ((marked | kind) << 16) | sequence) + bigEndian(time) + bigEndian(0x2a) +
         content;
}

/// RTCP: which time of the sender's clock belongs to which of RTP's.
QByteArray senderReport(quint32 time, std::chrono::milliseconds behind) {
  constexpr qint64 from1900 = 2'208'988'800;
  const qint64 now = QDateTime::currentMSecsSinceEpoch() - behind.count();
  const auto seconds = static_cast<quint32>(now / 1000 + from1900);
  const auto fraction = static_cast<quint32>(static_cast<double>(now % 1000) / 1000.0 * 4294967296.0);
  return bigEndian(0x80c80006u) + bigEndian(0x2a) + bigEndian(seconds) + bigEndian(fraction) +
         bigEndian(time) + bigEndian(1) + bigEndian(1);
}

QByteArray interleaved(int channel, const QByteArray& packet) {
  return QByteArray("$") + static_cast<char>(channel) + bigEndian(static_cast<quint32>(packet.size()), 2) +
         packet;
}

}  // namespace

QByteArray jpegPicture(QSize size, const QColor& colour) {
  QImage picture(size, QImage::Format_RGB32);
  picture.fill(colour);
  QByteArray packed;
  QBuffer buffer(&packed);
  picture.save(&buffer, "JPEG", 95);
  return packed;
}

struct TransportStream::Muxer {
  AVFormatContext* output = nullptr;
  AVCodecContext* codec = nullptr;
  AVFrame* frame = av_frame_alloc();
  AVPacket* packet = av_packet_alloc();
  QByteArray elementary;
  std::int64_t time = 0;

  Muxer() {
    demand(avformat_alloc_output_context2(&output, nullptr, "mpegts", nullptr) >= 0 &&
           avformat_new_stream(output, nullptr) != nullptr);
  }
  ~Muxer() {
    if (output->pb != nullptr) taken();
    avcodec_free_context(&codec);
    av_frame_free(&frame);
    av_packet_free(&packet);
    avformat_free_context(output);
  }

  void begin(QSize size) {
    avcodec_free_context(&codec);
    const AVCodec* kind = avcodec_find_encoder(AV_CODEC_ID_MPEG2VIDEO);
    demand(kind != nullptr);
    codec = avcodec_alloc_context3(kind);
    codec->width = size.width();
    codec->height = size.height();
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    codec->time_base = {1, 25};
    codec->framerate = {25, 1};
    codec->gop_size = 0;
    codec->bit_rate = 4'000'000;
    codec->thread_count = 1;
    demand(avcodec_open2(codec, kind, nullptr) >= 0);
    av_frame_unref(frame);
    frame->format = AV_PIX_FMT_YUV420P;
    frame->width = size.width();
    frame->height = size.height();
    demand(av_frame_get_buffer(frame, 0) >= 0);
    const bool isFirst = output->streams[0]->codecpar->width == 0;
    demand(avcodec_parameters_from_context(output->streams[0]->codecpar, codec) >= 0);
    if (!isFirst) return;
    output->streams[0]->time_base = codec->time_base;
    demand(avio_open_dyn_buf(&output->pb) >= 0 && avformat_write_header(output, nullptr) >= 0);
  }

  QByteArray taken() {
    std::uint8_t* bytes = nullptr;
    const int size = avio_close_dyn_buf(output->pb, &bytes);
    output->pb = nullptr;
    QByteArray result(reinterpret_cast<const char*>(bytes), size);
    av_free(bytes);
    return result;
  }
};

TransportStream::TransportStream() : muxer_(std::make_unique<Muxer>()) {}
TransportStream::~TransportStream() = default;

QByteArray TransportStream::picture(QSize size, const Samples& colour) {
  Muxer& to = *muxer_;
  if (to.codec == nullptr || QSize(to.codec->width, to.codec->height) != size) to.begin(size);
  if (to.output->pb == nullptr) demand(avio_open_dyn_buf(&to.output->pb) >= 0);
  demand(av_frame_make_writable(to.frame) >= 0);
  for (int plane = 0; plane < 3; ++plane) {
    const int lines = plane == 0 ? size.height() : (size.height() + 1) / 2;
    std::fill_n(to.frame->data[plane], lines * to.frame->linesize[plane],
                static_cast<std::uint8_t>(colour[static_cast<std::size_t>(plane)]));
  }
  to.frame->pts = to.time++;
  demand(avcodec_send_frame(to.codec, to.frame) >= 0);
  to.elementary.clear();
  while (avcodec_receive_packet(to.codec, to.packet) == 0) {
    to.elementary.append(reinterpret_cast<const char*>(to.packet->data), to.packet->size);
    av_packet_rescale_ts(to.packet, to.codec->time_base, to.output->streams[0]->time_base);
    to.packet->stream_index = 0;
    demand(av_write_frame(to.output, to.packet) >= 0);
    av_packet_unref(to.packet);
  }
  av_write_frame(to.output, nullptr);
  return to.taken();
}

QByteArray TransportStream::elementary() const {
  return muxer_->elementary;
}

HttpSender::HttpSender(SenderWay itsWay) : way(itsWay) {
  connect(&server_, &QTcpServer::newConnection, this, [this] {
    while (QTcpSocket* visitor = server_.nextPendingConnection()) {
      ++visits_;
      visitors_.insert(visitor, std::make_shared<Visitor>());
      connect(visitor, &QTcpSocket::readyRead, this, [this, visitor] { answer(visitor); });
      connect(visitor, &QTcpSocket::disconnected, this, [this, visitor] {
        visitors_.remove(visitor);
        visitor->deleteLater();
      });
    }
  });
  connect(&clock_, &QTimer::timeout, this, &HttpSender::send);
  demand(start());
}

QString HttpSender::url(const QString& path) const {
  return QString("http://127.0.0.1:%1/%2").arg(port_).arg(path);
}

bool HttpSender::start() {
  clock_.start(interval);
  if (!server_.listen(QHostAddress::LocalHost, port_)) return false;
  port_ = server_.serverPort();
  return true;
}

void HttpSender::stop() {
  clock_.stop();
  server_.close();
  for (QTcpSocket* visitor : visitors_.keys()) visitor->abort();
}

void HttpSender::answer(QTcpSocket* visitor) {
  const std::shared_ptr<Visitor> known = visitors_.value(visitor);
  if (!known || known->isAnswered) return;
  known->request += visitor->readAll();
  if (!known->request.contains("\r\n\r\n") || way == SenderWay::silent) return;
  known->isAnswered = true;
  const bool isStream = known->request.startsWith("GET /ts");
  const QByteArray password = "Basic " + QByteArray("user:pa:ss@/word").toBase64();
  if (way == SenderWay::wantsPassword && !known->request.contains(password)) {
    visitor->write(
        "HTTP/1.1 401 Unauthorized\r\nWWW-Authenticate: Basic realm=\"stage\"\r\nContent-Length: 0\r\n"
        "Connection: close\r\n\r\n");
    return visitor->disconnectFromHost();
  }
  const bool isFilm = known->request.startsWith("GET /film.ts");
  if (isFilm || way == SenderWay::garbage || way == SenderWay::text || way == SenderWay::list) {
    QByteArray content = "<!DOCTYPE html><html><body>Welcome</body></html>";
    quint32 noise = 1;
    if (way == SenderWay::garbage)
      for (content.clear(); content.size() < 20'000; content.append(static_cast<char>(noise >> 16)))
        noise = noise * 1'103'515'245 + 12'345;
    if (way == SenderWay::list)
      content = "#EXTM3U\n#EXT-X-TARGETDURATION:2\n#EXTINF:2,\n" + piece.toUtf8() + "\n#EXT-X-ENDLIST\n";
    if (isFilm) content = film;
    visitor->write("HTTP/1.1 200 OK\r\nConnection: close\r\nContent-Length: " +
                   QByteArray::number(content.size()) + "\r\n\r\n" + content);
    return visitor->disconnectFromHost();
  }
  if (isStream) known->stream = std::make_unique<TransportStream>();
  visitor->write(isStream
                     ? "HTTP/1.1 200 OK\r\nContent-Type: video/mp2t\r\n\r\n"
                     : "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace;boundary=next\r\n\r\n");
}

void HttpSender::send() {
  constexpr int beforeFreezing = 5;
  const QByteArray jpeg = jpegPicture(sent.size, sent.colour);
  for (auto at = visitors_.begin(); at != visitors_.end(); ++at) {
    Visitor& visitor = *at.value();
    if (!visitor.isAnswered || at.key()->state() != QAbstractSocket::ConnectedState) continue;
    if (way == SenderWay::frozen && visitor.pictures >= beforeFreezing) continue;
    ++visitor.pictures;
    at.key()->write(visitor.stream ? visitor.stream->picture(sent.size, sent.samples)
                                   : "--next\r\nContent-Type: image/jpeg\r\nContent-Length: " +
                                         QByteArray::number(jpeg.size()) + "\r\n\r\n" + jpeg + "\r\n");
  }
}

DatagramSender::DatagramSender(quint16 port, bool isRtp) : port_(port), isRtp_(isRtp) {
  connect(&clock_, &QTimer::timeout, this, &DatagramSender::send);
  clock_.start(interval);
}

void DatagramSender::send() {
  const QByteArray bytes = stream_.picture(sent.size, sent.samples);
  for (qsizetype at = 0; at < bytes.size(); at += perDatagram) {
    const QByteArray part = bytes.mid(at, perDatagram);
    socket_.writeDatagram(isRtp_ ? rtpPacket(transportStream, part, sequence_++, time_) : part,
                          QHostAddress::LocalHost, port_);
  }
  time_ += ticks;
}

RtspSender::RtspSender() {
  connect(&server_, &QTcpServer::newConnection, this, [this] {
    while (QTcpSocket* visitor = server_.nextPendingConnection()) {
      requests_.insert(visitor, {});
      connect(visitor, &QTcpSocket::readyRead, this, [this, visitor] { read(visitor); });
      connect(visitor, &QTcpSocket::disconnected, this, [this, visitor] {
        if (playing_ == visitor) playing_ = nullptr;
        requests_.remove(visitor);
        visitor->deleteLater();
      });
    }
  });
  connect(&clock_, &QTimer::timeout, this, &RtspSender::send);
  demand(server_.listen(QHostAddress::LocalHost));
  clock_.start(interval);
}

RtspSender::~RtspSender() {
  for (QTcpSocket* visitor : requests_.keys()) visitor->abort();
}

QString RtspSender::url(const QString& user) const {
  return "rtsp://" + (user.isEmpty() ? user : user + '@') +
         QString("127.0.0.1:%1/live").arg(server_.serverPort());
}

void RtspSender::read(QTcpSocket* visitor) {
  QByteArray& waiting = requests_[visitor];
  waiting += visitor->readAll();
  for (qsizetype end = waiting.indexOf("\r\n\r\n"); end >= 0; end = waiting.indexOf("\r\n\r\n")) {
    const QByteArray request = waiting.left(end + 2);
    waiting.remove(0, end + 4);
    const qsizetype mark = request.indexOf("CSeq:");
    const QByteArray head =
        "CSeq: " + request.mid(mark + 5, request.indexOf("\r\n", mark) - mark - 5).trimmed() +
        "\r\nSession: 7\r\n";
    if (wantsPassword && !request.contains("Basic " + QByteArray("user:secret").toBase64())) {
      visitor->write("RTSP/1.0 401 Unauthorized\r\n" + head +
                     "WWW-Authenticate: Basic realm=\"stage\"\r\n\r\n");
      continue;
    }
    QByteArray more, content;
    if (request.startsWith("OPTIONS")) {
      more = "Public: OPTIONS, DESCRIBE, SETUP, PLAY, TEARDOWN, GET_PARAMETER\r\n";
    } else if (request.startsWith("DESCRIBE")) {
      content =
          "v=0\r\no=- 1 1 IN IP4 127.0.0.1\r\ns=stage\r\nt=0 0\r\nm=video 0 RTP/AVP "
          "32\r\na=control:video\r\n";
      more =
          "Content-Type: application/sdp\r\nContent-Length: " + QByteArray::number(content.size()) + "\r\n";
    } else if (request.startsWith("SETUP")) {
      more = "Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\n";
    } else if (request.startsWith("PLAY")) {
      playing_ = visitor;
    }
    visitor->write("RTSP/1.0 200 OK\r\n" + head + more + "\r\n" + content);
  }
}

void RtspSender::send() {
  if (playing_ == nullptr) return;
  if (pictures_++ % 25 == 0) playing_->write(interleaved(1, senderReport(time_, clockIsBehind)));
  stream_.picture(sent.size, sent.samples);
  const QByteArray bytes = stream_.elementary();
  const QByteArray head(4, 0);  // RFC 2250
  for (qsizetype at = 0; at < bytes.size(); at += perDatagram)
    playing_->write(interleaved(0, rtpPacket(mpegVideo, head + bytes.mid(at, perDatagram), sequence_++, time_,
                                             at + perDatagram >= bytes.size())));
  time_ += ticks;
}

bool SrtSender::isThere() {
  void* place = nullptr;
  while (const char* name = avio_enum_protocols(&place, 1))
    if (qstrcmp(name, "srt") == 0) return true;
  return false;
}

SrtSender::SrtSender(quint16 port) : thread_([this, port] { run(port); }) {}

SrtSender::~SrtSender() {
  stopped_ = true;
  thread_.join();
}

void SrtSender::run(quint16 port) {
  const QByteArray url = QString("srt://127.0.0.1:%1?mode=listener").arg(port).toLatin1();
  const AVIOInterruptCB interrupt{
      [](void* stopped) { return static_cast<int>(*static_cast<std::atomic<bool>*>(stopped)); }, &stopped_};
  AVIOContext* to = nullptr;
  if (avio_open2(&to, url.constData(), AVIO_FLAG_WRITE, &interrupt, nullptr) < 0) return;
  TransportStream stream;
  while (!stopped_) {
    const QByteArray bytes = stream.picture({64, 48}, isGreen ? Samples{145, 54, 34} : Samples{81, 90, 240});
    avio_write(to, reinterpret_cast<const unsigned char*>(bytes.constData()), static_cast<int>(bytes.size()));
    avio_flush(to);
    std::this_thread::sleep_for(std::chrono::milliseconds(interval));
  }
  avio_close(to);
}

quint16 freeUdpPort() {
  QUdpSocket socket;
  demand(socket.bind(QHostAddress::LocalHost, 0));
  return socket.localPort();
}

}  // namespace relucent::test
