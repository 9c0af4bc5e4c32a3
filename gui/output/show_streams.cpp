// SPDX-License-Identifier: MIT
#include "output/show_streams.h"

#include <QJsonObject>

#include "relucent/base/message.h"

namespace relucent::gui {
namespace {

using Phase = LiveState::Phase;

// Beyond this the clocks disagree, and nobody knows by how much.
constexpr double longestWay = 60.0;  // seconds

QString phaseName(Phase phase) {
  switch (phase) {
    case Phase::connecting:
      return "connecting";
    case Phase::asking:
      return "asking";
    case Phase::playing:
      return "playing";
    case Phase::lost:
      return "lost";
  }
  return {};
}

Message lostSentence(const LiveState& stream) {
  const std::string address = stream.address.toStdString();
  return stream.turnsBlack
             ? RELUCENT_ENGLISH_MESSAGE("show.stream-lost-black", "{} is lost: {}; black until it is back")
                   .with(address, stream.problem)
             : RELUCENT_ENGLISH_MESSAGE("show.stream-lost",
                                        "{} is lost: {}; its last picture stays until it is back")
                   .with(address, stream.problem);
}

}  // namespace

std::vector<StreamTeller::Line> StreamTeller::news(const std::vector<LiveState>& streams, Time now) {
  std::vector<Line> lines;
  for (const LiveState& stream : streams) {
    const std::string address = stream.address.toStdString();
    const auto [place, isNew] = told_.try_emplace(stream.address);
    Told& told = place->second;
    if (isNew)
      lines.push_back({RELUCENT_ENGLISH_MESSAGE("show.stream-begins", "connecting to {}").with(address)});
    if (told.opening != stream.opening) {
      told.opening = stream.opening;
      told.losses = 0;
    }
    if (stream.losses > told.losses && !told.isLost) {
      lines.push_back({lostSentence(stream), true});
      told.isLost = true;
      told.since = now;
    }
    told.losses = stream.losses;
    if (stream.phase != Phase::playing) continue;
    const Argument size = as::size(stream.size.width(), stream.size.height());
    if (told.isLost)
      lines.push_back({RELUCENT_ENGLISH_MESSAGE("show.stream-back", "{} is back after {} s")
                           .with(address, as::seconds(std::chrono::duration<double>(now - told.since).count(),
                                                      as::decimals(0)))});
    if (told.size.isEmpty())
      lines.push_back({RELUCENT_ENGLISH_MESSAGE("show.stream-plays", "{} plays, {}").with(address, size)});
    else if (told.size != stream.size)
      lines.push_back(
          {RELUCENT_ENGLISH_MESSAGE("show.stream-size", "{} has another size now: {}").with(address, size)});
    told.isLost = false;
    told.size = stream.size;
  }
  return lines;
}

QJsonArray toJson(const std::vector<LiveState>& streams) {
  QJsonArray array;
  for (const LiveState& stream : streams) {
    QJsonObject object{
        {"address", stream.address}, {"state", phaseName(stream.phase)}, {"losses", stream.losses}};
    if (stream.phase == Phase::lost)
      object["problem"] = QString::fromStdString(englishSentence(stream.problem));
    if (!stream.size.isEmpty())
      object["size"] = QString("%1x%2").arg(stream.size.width()).arg(stream.size.height());
    if (const std::optional<double> way = stream.senderSeconds; way && *way >= 0.0 && *way < longestWay)
      object["sender_milliseconds"] = 1e3 * *way;
    array.append(object);
  }
  return array;
}

}  // namespace relucent::gui
