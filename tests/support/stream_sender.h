// SPDX-License-Identifier: MIT
#pragma once

#include <QByteArray>
#include <QColor>
#include <QHash>
#include <QObject>
#include <QSize>
#include <QTcpServer>
#include <QTcpSocket>
#include <QTimer>
#include <QUdpSocket>
#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <thread>

namespace relucent::test {

/// Luma and chroma, BT.601, video range.
using Samples = std::array<int, 3>;

QByteArray jpegPicture(QSize size, const QColor& colour);

/// Pictures of one colour each as an MPEG transport stream with MPEG-2 video, by FFmpeg's own encoder: each
/// is complete in itself.
class TransportStream {
 public:
  TransportStream();
  ~TransportStream();
  /// The bytes of the next picture, a multiple of 188; another size begins another video within the stream.
  QByteArray picture(QSize size, const Samples& colour);
  /// The last picture's video alone.
  QByteArray elementary() const;

 private:
  struct Muxer;
  std::unique_ptr<Muxer> muxer_;
};

/// What is sent, 25 times a second.
struct SentPicture {
  QSize size{64, 48};
  QColor colour = Qt::red;       // of JPEG pictures
  Samples samples{81, 90, 240};  // of a transport stream: red
};

/// How it behaves.
enum class SenderWay {
  plays,
  silent,         // takes the request, and says nothing
  garbage,        // answers with noise
  frozen,         // sends some pictures, then no more, and stays connected
  text,           // answers with a web page
  list,           // answers with a list of pieces (HLS), one, but for /film.ts
  wantsPassword,  // "user", "pa:ss@/word"
};

/// A web server at the loopback network that sends a live picture to whoever asks: at /mjpeg as Motion JPEG,
/// at /ts as a transport stream, at /film.ts as one that is there at once. On the caller's thread.
class HttpSender : public QObject {
 public:
  explicit HttpSender(SenderWay way = SenderWay::plays);
  ~HttpSender() override { stop(); }
  /// "http://127.0.0.1:port/path".
  QString url(const QString& path = "mjpeg") const;
  quint16 port() const { return port_; }
  /// Refuses and drops everybody, until it is started again at the same port.
  void stop();
  bool start();
  int visits() const { return visits_; }
  qsizetype visitors() const { return visitors_.size(); }

  SentPicture sent;
  SenderWay way;
  QString piece;    // address of the list's
  QByteArray film;  // at /film.ts

 private:
  void answer(QTcpSocket* visitor);
  void send();

  struct Visitor {
    QByteArray request;
    bool isAnswered = false;
    int pictures = 0;
    std::unique_ptr<TransportStream> stream;  // nullptr: Motion JPEG
  };
  QTcpServer server_;
  QTimer clock_;
  quint16 port_ = 0;
  int visits_ = 0;
  QHash<QTcpSocket*, std::shared_ptr<Visitor>> visitors_;
};

/// The same stream to a port of this computer, as UDP or as RTP.
class DatagramSender : public QObject {
 public:
  DatagramSender(quint16 port, bool isRtp);
  SentPicture sent;

 private:
  void send();
  QUdpSocket socket_;
  QTimer clock_;
  quint16 port_;
  bool isRtp_;
  quint16 sequence_ = 0;
  quint32 time_ = 0;
  TransportStream stream_;
};

/// An RTSP server as cameras have it: MPEG-2 video as RTP within the connection, with the sender's clock.
class RtspSender : public QObject {
 public:
  RtspSender();
  ~RtspSender() override;
  QString url(const QString& user = {}) const;
  SentPicture sent;
  bool wantsPassword = false;  // "user", "secret"
  std::chrono::milliseconds clockIsBehind{0};

 private:
  void read(QTcpSocket* visitor);
  void send();
  QTcpServer server_;
  QTimer clock_;
  QHash<QTcpSocket*, QByteArray> requests_;
  QTcpSocket* playing_ = nullptr;
  quint16 sequence_ = 0;
  quint32 time_ = 0;
  int pictures_ = 0;
  TransportStream stream_;
};

/// The transport stream over SRT, which waits for its receiver. On a thread of its own, as its calls block.
class SrtSender {
 public:
  explicit SrtSender(quint16 port);
  ~SrtSender();
  /// Of FFmpeg as it is installed.
  static bool isThere();
  std::atomic<bool> isGreen{false};  // red at first

 private:
  void run(quint16 port);
  std::atomic<bool> stopped_{false};
  std::thread thread_;
};

/// A port that was free a moment ago.
quint16 freeUdpPort();

}  // namespace relucent::test
