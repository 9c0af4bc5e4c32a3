// SPDX-License-Identifier: MIT
#include "gui/monkey/walk.h"

#include <QFile>
#include <QProcess>
#include <QRegularExpression>
#include <QThread>
#include <algorithm>

namespace relucent::gui {
namespace {

constexpr int lastActions = 25;  // that a finding tells
constexpr int aTick = 60;        // milliseconds between looks
constexpr int longestEnd = 45'000;

/// Equal for what differs in figures and names alone.
QString kindOfFinding(QString what) {
  what.replace(QRegularExpression("[0-9][0-9.,]*"), "#");
  return what.left(140);
}

/// The program's functions by name, where the computer has binutils.
QString named(const QString& frame) {
  static const QRegularExpression place(R"(^(.*/relucent)\(\+(0x[0-9a-f]+)\))");
  const QRegularExpressionMatch match = place.match(frame);
  if (!match.hasMatch()) return frame;
  QProcess tool;
  tool.start("addr2line", {"-Cfe", match.captured(1), match.captured(2)});
  if (!tool.waitForFinished(20'000)) return frame;
  return QString::fromLocal8Bit(tool.readAllStandardOutput()).section('\n', 0, 0).left(160);
}

/// Of the program alone where it is in there: what is under it is Qt's and the system's.
QString namedAll(const QStringList& frames) {
  constexpr qsizetype mostNames = 14;
  QStringList names;
  for (const QString& frame : frames)
    if (const QString name = named(frame); name != frame) names << "    " + name;
  return (names.isEmpty() ? frames : names).mid(0, mostNames).join('\n');
}

bool copyFolder(const QString& from, const QString& to) {
  return QFile::exists(from) && QProcess::execute("cp", {"-r", from, to}) == 0;
}

}  // namespace

Walk::Walk(unsigned seed, FailingRoom& room, QDir home, QDir venues, QDir stock)
    : seed_(seed),
      random_(seed),
      room_(room),
      home_(std::move(home)),
      venues_(std::move(venues)),
      invariants_(room) {
  // One after the other: a new venue with devices, what was measured by them, a rehearsal, the first start.
  const bool hasReal = copyFolder(stock.filePath("real"), venues_.filePath("real"));
  const bool hasRehearsal = copyFolder(stock.filePath("rehearsal"), venues_.filePath("rehearsal"));
  leads_ = seed % 4 == 1 || (seed % 4 == 2 && !hasReal);
  if (seed % 4 == 2 && hasReal) opened_ = venues_.filePath("real");
  if (seed % 4 == 3 && hasRehearsal) opened_ = venues_.filePath("rehearsal");
}

Walk::~Walk() {
  program_.reset();
  room_.putRight();
}

void Walk::start() {
  QProcessEnvironment own = QProcessEnvironment::systemEnvironment();
  own.insert("HOME", home_.path());
  for (const char* kind : {"CONFIG", "CACHE", "DATA"})
    own.insert(QString("XDG_%1_HOME").arg(kind), home_.filePath(QString(kind).toLower()));
  own.insert("LC_ALL", "C.UTF-8");
  own.insert("BROWSER", "/bin/true");
  program_ = std::make_unique<test::DrivenProgram>(RELUCENT_TEST_PLUGINS, own);
  program_->watch(errors());
  mayEnd_ = false;
  QDir::setCurrent(home_.path());  // where a name without a folder leads
  program_->start(qEnvironmentVariable("RELUCENT_PROGRAM"),
                  opened_.isEmpty() ? QStringList() : QStringList{opened_});
}

bool Walk::tryFor(const std::function<bool()>& done, int seconds) const {
  for (int waited = 0; waited < 1000 * seconds && program_->isRunning(); waited += aTick) {
    if (done()) return true;
    QThread::msleep(aTick);
  }
  return false;
}

bool Walk::leadToMeasuring() {
  const auto click = [this](const QString& name) {
    return tryFor([&] { return program_->click(name).isEmpty(); });
  };
  const auto clickText = [this](const QString& text) {
    return tryFor([&] { return program_->clickText(text).isEmpty(); });
  };
  const auto isCurrent = [this](int step) {
    return tryFor(
        [&] { return program_->look().part(QString("step-%1").arg(step)).spoken.endsWith("current"); }, 60);
  };
  actions_ << "begins a venue with the room's devices and measures";
  return click("new-venue") && program_->type("venue-name", "Walk").isEmpty() &&
         program_->type("venue-folder", venues_.path()).isEmpty() && click("venue-screen-DUMMY1") &&
         click("room-is-clear") && click("primary") && isCurrent(2) && clickText("Choose") &&
         click("primary") && isCurrent(3) && click("levels") && program_->press("9").isEmpty() &&
         program_->press("Return").isEmpty() && click("primary") &&
         tryFor([this] { return program_->look().part("step-3").spoken.endsWith("done"); }, 60) &&
         click("primary") && isCurrent(4) && clickText("Fast") && click("primary") && clickText("Start now");
}

Action Walk::next(const QJsonArray& usable) {
  const unsigned dice = random_() % 100;
  if (dice < 8) return shortcut(random_);
  if (dice < 11) return resize(random_);
  if (dice < 18) return {{{"do", "room"}}, {}};
  if (dice < 19) return {{{"do", "close"}}, "closes the window"};
  if (dice == 19 && random_() % 4 == 0)
    return {{{"do", "terminate"}}, "asks the program to end, as the desktop does"};
  if (dice == 20 && random_() % 4 == 0) return {{{"do", "kill"}}, "kills the program"};
  if (dice < 24) return {{{"do", "wait"}}, "waits"};
  return useOf(usable, venues_.path(), random_).value_or(Action{{{"do", "wait"}}, "waits"});
}

void Walk::act(const Action& action) {
  const QString what = action.wish["do"].toString();
  QString words = action.words;
  if (what == "room") words = room_.change(random_);
  actions_ << words;
  ++result_.actions;
  if (what == "wait") QThread::msleep(500 + random_() % 2500);
  if (what == "terminate") program_->terminate();
  if (what == "kill") program_->kill();
  mayEnd_ = mayEnd_ || what == "terminate" || what == "kill" || what == "close";
  if (what == "use" || what == "close" || what == "resize" || what == "shortcut") program_->ask(action.wish);
  // Somebody looks before they go on, mostly.
  QThread::msleep(random_() % 3 == 0 ? 10 : 50 + random_() % 400);
}

QJsonObject Walk::look(std::set<QString>& known) {
  std::vector<Suspicion> before;
  QElapsedTimer since;
  since.start();
  while (true) {
    const QJsonObject survey = program_->ask({{"do", "survey"}});
    if (survey.contains("failed") || !program_->isRunning()) return {};
    noteLoop(survey["loop"].toObject(), known);
    std::vector<Suspicion> now;
    for (const Suspicion& each : invariants_.broken(program_->look(), survey))
      if (!known.contains(kindOfFinding(each.what))) now.push_back(each);
    // Only what was there from the first look on goes on being suspected.
    if (since.elapsed() > aTick)
      std::erase_if(now, [&](const Suspicion& each) {
        return std::ranges::none_of(before, [&](const Suspicion& was) { return was.what == each.what; });
      });
    const double seconds = 1e-3 * static_cast<double>(since.elapsed());
    for (const Suspicion& each : now)
      if (seconds >= each.stays) found(each.what, known);
    std::erase_if(now, [&](const Suspicion& each) { return seconds >= each.stays; });
    if (now.empty()) return survey;
    before = now;
    QThread::msleep(aTick);
  }
}

void Walk::noteLoop(const QJsonObject& loop, std::set<QString>& known) {
  const QJsonArray waits = loop["waits"].toArray();
  for (std::size_t i = 0; i < result_.waits.counts.size() && i < static_cast<std::size_t>(waits.size()); ++i)
    result_.waits.counts[i] += waits[static_cast<qsizetype>(i)].toInt();
  result_.waits.longest = std::max(result_.waits.longest, loop["longest"].toDouble());
  if (!findsWaits_) return;
  for (const QJsonValue& block : loop["blocks"].toArray()) {
    QStringList frames;
    for (const QJsonValue& frame : block["where"].toArray()) frames << frame.toString();
    found(QString("the window did not answer for %1 ms\n%2")
              .arg(qRound(block["ms"].toDouble()))
              .arg(namedAll(frames)),
          known);
  }
}

void Walk::noteEnd(std::set<QString>& known) {
  if (program_->isRunning() && !program_->hasEnded(longestEnd)) {
    // Gone for longer than what aborts a program whose loop hangs.
    found("the program does not answer and does not end", known);
    program_->kill();
  }
  QFile said(errors());
  QStringList lines;
  if (said.open(QIODevice::ReadOnly))
    lines = QString::fromLocal8Bit(said.readAll()).split('\n', Qt::SkipEmptyParts);
  said.close();
  const auto isEnd = [](const QString& line) {
    return line.startsWith("HUNG") || line.startsWith("CRASHED");
  };
  const auto end = std::ranges::find_if(lines, isEnd);
  if (end != lines.end())
    found(*end + '\n' + namedAll(QStringList(end + 1, lines.end())), known);
  else if (!mayEnd_)
    found(QString("the program has ended with %1, which nobody asked for: %2")
              .arg(program_->exitCode())
              .arg(lines.isEmpty() ? QString() : lines.last()),
          known);
  for (const QString& line : lines)
    if (line.contains(QRegularExpression(
            "^(QObject|QWidget|QPainter|QLayout|QTimer|QThread|QAction|QSocket)\\w*(:|::)")))
      found("Qt complains: " + line, known);
  QFile::remove(errors());
}

void Walk::found(const QString& what, std::set<QString>& known) {
  if (!known.insert(kindOfFinding(what)).second) return;
  QStringList led = actions_.mid(std::max<qsizetype>(0, actions_.size() - lastActions));
  result_.findings << QString("seed %1, action %2: %3\n  after %4")
                          .arg(seed_)
                          .arg(result_.actions)
                          .arg(what, led.join("\n        "));
  qWarning("%s", qPrintable(result_.findings.last()));
}

WalkResult Walk::run(int actions, std::set<QString>& known, double mostSeconds, bool findsWaits) {
  findsWaits_ = findsWaits;
  QElapsedTimer since;
  since.start();
  const int before = room_.photographs();
  start();
  if (leads_ && !leadToMeasuring()) {
    found("the way to a measurement does not go on", known);
    for (const QString& line : program_->look().text().split('\n')) qInfo("%s", qPrintable(line));
  }
  while (result_.actions < actions && 1e-3 * static_cast<double>(since.elapsed()) < mostSeconds) {
    const QJsonObject survey = look(known);
    if (survey.isEmpty()) {
      noteEnd(known);
      ++result_.restarts;
      actions_ << "starts the program again";
      start();
      tryFor([this] { return !program_->look().windows().empty(); });
      if (!program_->isRunning()) break;
      continue;
    }
    act(next(survey["usable"].toArray()));
  }
  room_.putRight();
  // It ends when it is asked to, whatever it does.
  actions_ << "asks the program to end, as the desktop does";
  mayEnd_ = true;
  program_->terminate();
  if (!program_->hasEnded(longestEnd)) {
    found("the program does not end within 45 s of being asked to; it shows:\n" + program_->look().text(),
          known);
    program_->kill();
  }
  noteEnd(known);
  result_.photographs = room_.photographs() - before;
  return result_;
}

}  // namespace relucent::gui
