// SPDX-License-Identifier: MIT
// Playlists, addresses of content, and remote controls of the desktop program.
#include <QByteArray>
#include <QString>
#include <algorithm>

#include "content/content_address.h"
#include "content/playlist.h"
#include "content/set_times.h"
#include "content/stream_address.h"
#include "fuzz/scratch.h"
#include "fuzz/targets.h"
#include "relucent/base/error.h"
#include "remote/osc_message.h"

namespace relucent::fuzz {
namespace {

using namespace relucent::gui;

std::vector<std::string> playlistSeeds() {
  return {R"({"version": 2, "loop": true, "fade_seconds": 1, "items": [{"path": "a.png", "seconds": 10,)"
          R"("pictures_per_second": 25}, {"path": "stream:rtsp://user:secret@host/live#hold=black"},)"
          R"({"path": "chart:grid", "set": "Evening"}], "sets": [{"from": "18:00", "set": "Evening"}]})"};
}
void fuzzPlaylist(Bytes input) {
  const auto path = scratchFile("input.playlist", textOf(input));
  const PlaylistSettings settings = readPlaylist(QString::fromStdString(path.string()));
  if (!problems(settings).empty()) throw std::logic_error("a playlist with problems was read");
}

std::vector<std::string> oscSeeds() {
  std::vector<std::string> seeds;
  for (const OscMessage& message :
       {OscMessage{"/viewer", {0.5, 0.25}}, OscMessage{"/set", {QString("Evening")}}, OscMessage{"/next", {}},
        OscMessage{"/item", {3.0}}})
    seeds.push_back(oscDatagram(message).toStdString());
  std::string bundle = std::string("#bundle\0\0\0\0\0\0\0\0\1", 16);
  for (std::size_t i = 0; i < 2; ++i) {
    bundle += {'\0', '\0', '\0', static_cast<char>(seeds[i].size())};
    bundle += seeds[i];
  }
  seeds.push_back(bundle);
  bundle = std::string("#bundle\0\0\0\0\0\0\0\0\1", 16) +
           std::string{'\0', '\0', '\0', static_cast<char>(bundle.size())} + bundle;
  seeds.push_back(bundle);
  return seeds;
}
void fuzzOsc(Bytes input) {
  const std::string_view text = textOf(input);
  oscMessages(QByteArray(text.data(), static_cast<qsizetype>(text.size())));
}

std::vector<std::string> addressSeeds() {
  return {"rtsp://user:password@192.168.1.70:554/live#hold=last",
          "srt://:9000?mode=listener",
          "udp://239.0.0.1:1234",
          "https://host/a.m3u8?key=secret",
          "rtsp://[fe80::1]:554/a",
          "stream:rtmp://host/app",
          "chart:grid",
          "18:00=Evening",
          "6:30=Morning",
          "window:Slides"};
}
void fuzzAddresses(Bytes input) {
  const std::string_view text = textOf(input);
  const QString word = QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
  shownPath(word);
  shownStream(word);
  addressOf(word);
  if (const std::optional<SetTime> time = setTimeFrom(word)) {
    if (setTimeFrom(textOf(*time)) != time) throw std::logic_error("a time is read differently once written");
    setAt({*time}, QTime(12, 0));
  }
  streamAddressFrom(word);
}

}  // namespace

std::vector<FuzzTarget> showTargets() {
  return {{"playlist", fuzzPlaylist, playlistSeeds, Form::json, 800},
          {"remote controls",
           fuzzOsc,
           oscSeeds,
           Form::bytes,
           5000,
           {std::string("#bundle\0", 8), ",ifsbhtdScrmTFNI[]", std::string(",s\0\0", 4),
            std::string("\0\0\0\x10", 4), "\xff\xff\xff\xff"}},
          {"streams and times",
           fuzzAddresses,
           addressSeeds,
           Form::bytes,
           3000,
           {"://", "@", ":", "#hold=", "#hold=black", "?", "/", "[", "]", "%", "rtsp", "srt", "=", "24:00"}}};
}

}  // namespace relucent::fuzz
