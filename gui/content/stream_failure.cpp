// SPDX-License-Identifier: MIT
#include "content/stream_failure.h"

extern "C" {
#include <libavutil/error.h>
}

#include <array>

namespace relucent::gui {

Error streamUnusable() {
  return Error(ErrorKind::format,
               RELUCENT_MESSAGE("stream.unusable", "what comes is no video that can be shown"),
               RELUCENT_MESSAGE("stream.send-h264", "let it be sent as H.264 or Motion JPEG"));
}

Error streamSilent(double seconds, bool hasPlayed) {
  return Error(ErrorKind::device,
               (hasPlayed ? RELUCENT_MESSAGE("stream.stalled", "no picture has come for {} s")
                          : RELUCENT_MESSAGE("stream.silent", "no picture came within {} s"))
                   .with(as::seconds(seconds, as::digits(2))),
               RELUCENT_MESSAGE("stream.check-sender", "check the sender, the network, and the address"));
}

Error streamHostUnknown() {
  return Error(ErrorKind::device, RELUCENT_MESSAGE("stream.host-unknown", "its host is not found"),
               RELUCENT_MESSAGE("stream.check-host", "check the name in the address, or write the number"));
}

Error streamOpenAlready() {
  return Error(ErrorKind::device, RELUCENT_MESSAGE("stream.open-already", "this program plays it already"),
               RELUCENT_MESSAGE("stream.list-once", "put it into the playlist once"));
}

Error streamFailure(int code) {
  switch (code) {
    case AVERROR(EADDRINUSE):
      return Error(ErrorKind::device,
                   RELUCENT_MESSAGE("stream.port-in-use", "another program receives at its port"),
                   RELUCENT_MESSAGE("stream.end-other", "end that program, or send to another port"));
    case AVERROR(ECONNREFUSED):
      return Error(ErrorKind::device, RELUCENT_MESSAGE("stream.refused", "the connection was refused"),
                   RELUCENT_MESSAGE("stream.start-sender", "start the sender, and check the port"));
    case AVERROR(EHOSTUNREACH):
    case AVERROR(ENETUNREACH):
      return Error(ErrorKind::device, RELUCENT_MESSAGE("stream.unreachable", "its host cannot be reached"),
                   RELUCENT_MESSAGE("stream.check-network", "check the network and the address"));
    case AVERROR_HTTP_UNAUTHORIZED:
    case AVERROR_HTTP_FORBIDDEN:
      return Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("stream.wants-password", "it wants another user name and password"),
          RELUCENT_MESSAGE("stream.write-password", "write them into the address before the host: {}")
              .with("user:password@"));
    case AVERROR_HTTP_NOT_FOUND:
      return Error(ErrorKind::device, RELUCENT_MESSAGE("stream.no-such-path", "there is nothing at its path"),
                   RELUCENT_MESSAGE("stream.check-path", "check what stands behind the host in the address"));
    case AVERROR_EOF:
    case AVERROR(ECONNRESET):
    case AVERROR(EPIPE):
      return Error(ErrorKind::device, RELUCENT_MESSAGE("stream.ended", "it has ended"),
                   RELUCENT_MESSAGE("stream.start-sender-again", "start the sender again"));
    case AVERROR_INVALIDDATA:
    case AVERROR_DEMUXER_NOT_FOUND:
    case AVERROR_DECODER_NOT_FOUND:
    case AVERROR_STREAM_NOT_FOUND:
    case AVERROR_PATCHWELCOME:
      return streamUnusable();
    default:
      break;
  }
  std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
  av_strerror(code, reason.data(), reason.size());
  return Error(ErrorKind::device,
               RELUCENT_MESSAGE("stream.unreadable", "it cannot be read ({})").with(reason.data()),
               RELUCENT_MESSAGE("stream.check-sender", "check the sender, the network, and the address"));
}

}  // namespace relucent::gui
