// SPDX-License-Identifier: MIT
#include "gui/monkey/actions.h"

#include <QRegularExpression>
#include <QSize>
#include <QStringList>
#include <array>
#include <numeric>
#include <vector>

namespace relucent::gui {
namespace {

template <typename Range>
auto oneOf(const Range& all, std::mt19937& random) {
  return all[static_cast<decltype(all.size())>(random() % static_cast<std::size_t>(all.size()))];
}

double share(std::mt19937& random) {
  return static_cast<double>(random() % 1001) / 1000.0;
}

double weightOf(const QJsonObject& usable) {
  static const QRegularExpression lively(
      "^(Pause|Resume|Stop|Start|Try again|Measure|Close output|Go on|Rehearse)");
  static const QStringList needed{"room-is-clear", "new-venue", "rehearse"};
  const QString name = usable["name"].toString(), kind = usable["kind"].toString();
  if (usable["primary"].toBool()) return 14.0;
  if (needed.contains(name) || name.startsWith("venue-screen-"))
    return usable["checked"].toBool() ? 0.5 : 8.0;
  if (kind == "button" && lively.match(usable["text"].toString()).hasMatch()) return 8.0;
  if (name == "open-settings" || name == "open-help" || name == "settings-language") return 0.7;
  if (name == "settings-folder" || name == "venue-folder") return 0.3;
  if (kind == "files") return 8.0;
  return 2.0;
}

/// No path that leads out of where the walk may write.
QString typed(const QString& name, const QString& folder, std::mt19937& random) {
  if (name.contains("folder")) return folder + oneOf(QStringList{"", "/Other", "/New"}, random);
  return oneOf(QStringList{"", "0", "1", "9", "-5", "12", "3.75", "99999999", "Walk", "A name with spaces",
                           "50 % or so", "18:00", "127.0.0.1", "rtsp://127.0.0.1/x"},
               random);
}

QJsonArray place(std::mt19937& random) {
  return {share(random), share(random)};
}

}  // namespace

std::optional<Action> useOf(const QJsonArray& usable, const QString& folder, std::mt19937& random) {
  std::vector<double> weights;
  for (const QJsonValue& each : usable) weights.push_back(weightOf(each.toObject()));
  if (weights.empty()) return std::nullopt;
  std::discrete_distribution<int> which(weights.begin(), weights.end());
  const QJsonObject chosen = usable[which(random)].toObject();
  const QString kind = chosen["kind"].toString(), name = chosen["name"].toString();
  QJsonObject wish{{"do", "use"}, {"id", chosen["id"]}, {"from", place(random)}};
  QString words = QString("%1 \"%2\" (%3)").arg(kind, chosen["text"].toString().left(40), name);
  if (const QString window = chosen["window"].toString(); !window.isEmpty()) words += " in " + window;
  if (kind == "button" && random() % 12 == 0) {
    wish["twice"] = true;
    words += ", twice";
  } else if (kind == "choice" && random() % 4 != 0) {
    wish["keys"] = QJsonArray{oneOf(QStringList{"Down", "Up", "Home", "End"}, random)};
  } else if (kind == "rows" && random() % 6 == 0) {
    wish["twice"] = true;
  } else if ((kind == "slider" || kind == "picture") && random() % 2 == 0) {
    wish["to"] = place(random);
    words += ", dragged";
  } else if (kind == "field") {
    wish["typed"] = typed(name, folder, random);
    if (random() % 3 != 0)
      wish["keys"] = QJsonArray{oneOf(QStringList{"Return", "Tab", "Up", "Down"}, random)};
    words += ": " + wish["typed"].toString();
  } else if (kind == "files") {
    if (random() % 2 == 0)
      wish["typed"] = folder + oneOf(QStringList{"/real", "/rehearsal", "/saved.png", ""}, random);
    words += ": " + wish["typed"].toString();
  }
  if (wish.contains("keys")) words += " " + wish["keys"].toArray().first().toString();
  return Action{wish, words};
}

Action shortcut(std::mt19937& random) {
  static const QStringList keys{
      "Alt+1",    "Alt+2",    "Alt+3",       "Alt+4",       "Alt+5",  "Alt+6",  "Alt+7",        "Alt+8",
      "Alt+Left", "Alt+Left", "Ctrl+Return", "Ctrl+Return", "Ctrl+Z", "Ctrl+Z", "Ctrl+Shift+Z", "Ctrl+Y",
      "F1",       "F6",       "F9",          "F11",         "Escape", "Escape", "Tab",          "Shift+Tab",
      "Space",    "Return",   "A",           "Left",        "Up"};
  const QString chosen = oneOf(keys, random);
  return {{{"do", "shortcut"}, {"keys", chosen}}, "presses " + chosen};
}

Action resize(std::mt19937& random) {
  static const std::array sizes{QSize(960, 540), QSize(960, 540), QSize(1024, 700), QSize(1280, 720),
                                QSize(1366, 768)};
  const QSize size = oneOf(sizes, random);
  return {{{"do", "resize"}, {"width", size.width()}, {"height", size.height()}},
          QString("resizes to %1x%2").arg(size.width()).arg(size.height())};
}

}  // namespace relucent::gui
