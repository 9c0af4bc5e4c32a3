// SPDX-License-Identifier: MIT
#include "gui/monkey/invariants.h"

#include <QJsonArray>
#include <QRegularExpression>
#include <algorithm>

namespace relucent::gui {
namespace {

using test::Seen;
using test::SeenPart;

constexpr int steps = 8;
// Within which darkness follows, and a lost device is said; that is 5 s, on a computer that does other things
// besides.
constexpr double soonDark = 4.0, soonSaid = 12.0;
constexpr int fall = 20;  // permille that a forecast may be wrong by, when it is made anew

SeenPart stepOf(const Seen& seen, int number) {
  return seen.part(QString("step-%1").arg(number));
}

QString titleOf(const Seen& seen) {
  for (const test::SeenWindow& window : seen.windows())
    for (const SeenPart& part : window.parts)
      if (part.role == "title") return part.text;
  return {};
}

/// It is dark where a page says that it is.
void lookAtLight(const Seen& seen, const FailingRoom& room, std::vector<Suspicion>& all) {
  for (const char* words :
       {"Nothing is being projected.", "The output is closed. Nothing is projected from here."})
    if (seen.says(words) && room.isBright())
      all.push_back({QString("the projector shines, and it says: ") + words, soonDark});
}

/// Banner, rail and strip say the same of a device, which is what it is.
void lookAtDevices(const Seen& seen, const FailingRoom& room, std::vector<Suspicion>& all) {
  const QString banner = seen.part("banner-sentence").text;
  const SeenPart projector = seen.part("strip-projector"), camera = seen.part("strip-camera");
  if (projector.text.isEmpty()) return;  // another window stands before it
  const auto isAmber = [](const SeenPart& part) { return part.role == "amber"; };
  if (banner == "The camera does not answer" && !isAmber(camera))
    all.push_back({"the banner says that the camera does not answer, the strip: " + camera.text, 3.0});
  if (banner == "The projector's screen is unplugged" && !isAmber(projector))
    all.push_back({"the banner says that the screen is unplugged, the strip: " + projector.text, 3.0});
  const bool isOurs = projector.text.contains("DUMMY1");
  if (isOurs && room.isScreenPlugged() && isAmber(projector))
    all.push_back({"the screen is plugged, and the strip says: " + projector.text, soonSaid});
  if (isOurs && !room.isScreenPlugged() && !isAmber(projector))
    all.push_back({"the screen is unplugged, and the strip says: " + projector.text, soonSaid});
  if (isOurs && room.isScreenPlugged() && banner == "The projector's screen is unplugged")
    all.push_back({"the screen is plugged, and the banner says that it is not", soonSaid});
  if (room.isCameraPlugged() && camera.text.contains("silent"))
    all.push_back({"the camera is plugged, and the strip says: " + camera.text, 40.0});
}

/// One step has the projector.
void lookAtRail(const Seen& seen, std::vector<Suspicion>& all) {
  QStringList measuring;
  for (int step = 1; step <= steps; ++step) {
    const QString more = stepOf(seen, step).more;
    if (more.startsWith("Measuring")) measuring << QString::number(step);
    if (more.contains(QRegularExpression("100.?%.* left")))
      all.push_back({"work is left at 100 %: " + more, 3.0});
  }
  if (measuring.size() > 1) all.push_back({"several steps measure: " + measuring.join(", "), 2.0});
  if (!measuring.isEmpty() && stepOf(seen, steps).more == "Playing")
    all.push_back({"it plays while step " + measuring.first() + " measures", 2.0});
}

}  // namespace

void Invariants::lookAtProgress(const Seen& seen, const QJsonObject& progress, std::vector<Suspicion>& all) {
  if (!progress["shown"].toBool()) return work_.clear();
  const QString work = titleOf(seen) + ", " + seen.part("primary").text;
  const int permille = progress["permille"].toInt();
  // The work has grown where more is forecast than was.
  static const QRegularExpression of("(\\d+) of (?:about )?(\\d+)");
  const QRegularExpressionMatch counted = of.match(seen.text());
  const int forecast = counted.hasMatch() ? counted.captured(2).toInt() : 0;
  if (work == work_ && permille < permille_ - fall && forecast <= forecast_)
    all.push_back(
        {QString("progress falls from %1 to %2 permille at %3").arg(permille_).arg(permille).arg(work), 0.0});
  if (permille == 1000) all.push_back({"progress is whole, and work goes on at " + work, 8.0});
  work_ = work;
  permille_ = permille;
  forecast_ = forecast;
}

std::vector<Suspicion> Invariants::broken(const Seen& seen, const QJsonObject& survey) {
  std::vector<Suspicion> all;
  for (const QJsonValue& fault : survey["faults"].toArray()) all.push_back({fault.toString()});
  lookAtLight(seen, room_, all);
  lookAtDevices(seen, room_, all);
  lookAtRail(seen, all);
  lookAtProgress(seen, survey["progress"].toObject(), all);
  return all;
}

}  // namespace relucent::gui
