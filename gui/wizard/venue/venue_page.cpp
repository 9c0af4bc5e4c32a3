// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_page.h"

#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>

#include "output/venue_use.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/devices/command/command_consent.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/stored_settings.h"
#include "views/number_text.h"
#include "wizard/venue/venue_thumbnail.h"
#include "wizard/venue/venue_tidy.h"

namespace relucent::gui {
namespace {

const QString manifestName = calibration::CalibrationFolder::manifestName;

/// The programs that a venue names as its devices. Throws: Error{format, disk}.
std::vector<std::string> commandsIn(const std::filesystem::path& folder) {
  return pipeline::commandsOf(pipeline::settingsOf(calibration::CalibrationFolder::open(
                                                       folder, calibration::CalibrationFolder::Access::read))
                                  .rig);
}

/// A stranger's text on one line, that cannot turn or hide what stands beside it.
QString visibleText(const std::string& text) {
  QString visible;
  for (const QChar c : QString::fromStdString(text))
    visible += c.isPrint() && c.category() != QChar::Other_Format ? c : QChar(0xfffd);
  return visible;
}

QString sizeText(Size size) {
  return gui::sizeText(size.width, size.height);
}

}  // namespace

VenuePage::VenuePage(Session& session, RecentVenues recent, QObject* parent)
    : PageModel(stepName, parent),
      session_(session),
      recent_(recent),
      keeping_(session, recent),
      openScreen_(session),
      openPrograms_(session),
      endQuestion_(session) {
  continue_ = addCommand(Icon::next, [this] { Q_EMIT standingWanted(); });
  begin_ = addCommand(Icon::next, [this] { begin(); });
  useScreen_ = addCommand(Icon::projector, [this] { use([this] { openScreen_.apply(); }); });
  changeScreen_ = addCommand(Icon::projector, [this] { setMode(Mode::screen); });
  usePrograms_ = addCommand(Icon::settings, [this] { use([this] { openPrograms_.apply(); }); });
  changePrograms_ = addCommand(Icon::settings, [this] { setMode(Mode::programs); });
  remove_ = addCommand(Icon::remove, [this] { removeAsked(); });
  keepVenue_ = addCommand(Icon::folder, [] {});
  allowPrograms_ = addCommand(Icon::play, [this] { openAsked(true); });
  openWithout_ = addCommand(Icon::folder, [this] { openAsked(false); });
  parent_ = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + "/Relucent";
  venues_ = rehearsalVenues();
  setSizes({{{64, 48}, {48, 36}, QT_TR_NOOP("%1, a first look")},
            {{128, 96}, {80, 60}, QT_TR_NOOP("%1, quick")},
            {{256, 192}, {160, 120}, QT_TR_NOOP("%1, usual")},
            {{512, 384}, {320, 240}, QT_TR_NOOP("%1, fine")}});
  size_ = 1;
  script_.projector = {1024, 768};
  connect(&session_, &Session::stepsChanged, this, &VenuePage::tellSettings);
  connect(&session_, &Session::devicesChanged, this, &VenuePage::tellSettings);
  connect(&openScreen_, &VenueScreen::changed, this, &VenuePage::tellSettings);
  connect(&openPrograms_, &VenuePrograms::changed, this, &VenuePage::tellSettings);
  connect(&finder_, &CameraFinder::failed, this,
          [this](const Failure& failure) { Q_EMIT failed({failure, tr("Nothing was changed.")}); });
  connect(&network_, &VenueNetwork::changed, this, &VenuePage::tellSettings);
  connect(&network_, &VenueNetwork::failed, this,
          [this](const Failure& failure) { Q_EMIT failed({failure, tr("Nothing was changed.")}); });
  connect(&session_, &Session::acquisitionChanged, this, [this] { keepThumbnail(session_); });
  connect(&session_, &Session::opened, this, [this] {
    if (session_.isOpen()) recent_.add(QString::fromStdString(session_.path().string()));
    mode_ = Mode::start;
  });
  updateCommands();
}

QString VenuePage::title() const {
  switch (mode_) {
    case Mode::rehearse:
      return tr("Rehearse in a simulated venue");
    case Mode::script:
      return tr("New venue by script");
    case Mode::devices:
      return tr("New venue");
    case Mode::screen:
      return tr("The projector's screen");
    case Mode::programs:
      return tr("Programs of this venue");
    case Mode::start:
      break;
  }
  return tr("Venue");
}

QString VenuePage::subtitle() const {
  switch (mode_) {
    case Mode::rehearse:
      return tr(
          "The same steps, with a simulated projector and camera. Nothing is projected unless you choose a "
          "screen.");
    case Mode::script:
      return tr("Say which screen shines, which programs show and photograph, and where the work is kept.");
    case Mode::devices:
      return tr("Say which screens shine on the surface, which cameras watch, and where the work is kept.");
    case Mode::screen:
      return tr("Say which screen the projector is now. What was measured stays.");
    case Mode::programs:
      return tr("Say which commands drive these devices from now on. What was measured stays.");
    case Mode::start:
      break;
  }
  return tr(
      "Measures how a surface changes what is projected on it, and corrects pictures and films until they "
      "look "
      "right there.");
}

StepStatus VenuePage::status() const {
  const bool isAnother = mode_ != Mode::start && !isOfOpenVenue();
  if (!session_.isOpen()) return {StepState::open, isAnother ? tr("Setting up") : QString()};
  // The rest of the rail is of the one that is open.
  if (isAnother) return {StepState::done, tr("Setting up another")};
  if (session_.projectors() > 1 || session_.cameras() > 1) {
    const QString projectors = tr("%n projector(s)", nullptr, static_cast<int>(session_.projectors()));
    const QString cameras = tr("%n camera(s)", nullptr, static_cast<int>(session_.cameras()));
    return {StepState::done, tr("%1, %2").arg(projectors, cameras)};
  }
  if (const pipeline::ScreenRigSettings* screen = session_.screenRig())
    return {StepState::done,
            tr("%1, %2").arg(QString::fromStdString(screen->display.connector), sizeText(screen->projector))};
  QString kind = session_.isSimulated() ? tr("simulated, %1") : tr("by script, %1");
  return {StepState::done, kind.arg(sizeText(session_.projectorSize()))};
}

QString VenuePage::hint() const {
  if (mode_ == Mode::start)
    return session_.isOpen() ? tr("%1 is open").arg(session_.name())
                             : tr("Enter opens the highlighted choice");
  if (QString wrong = problem(); !wrong.isEmpty()) return wrong;
  if (isOfOpenVenue()) return tr("Nothing is measured again.");
  WorkLeft work = expected();
  const auto patterns = static_cast<int>(work.shots);
  return groupedText(tr("About %n pattern(s), %1", nullptr, patterns), patterns)
      .arg(bytesText(work.diskBytes));
}

void VenuePage::updateCommands() {
  const bool isBegun = session_.result(calibration::Stage::linearization).has_value();
  continue_->show(isBegun ? tr("Continue") : tr("Check camera"));
  useScreen_->show(tr("Use this screen"), problem().isEmpty());
  usePrograms_->show(tr("Use these commands"), problem().isEmpty());
  begin_->setGlyph(mode_ == Mode::rehearse ? Icon::play : Icon::next);
  begin_->show(mode_ == Mode::rehearse ? tr("Start rehearsal") : tr("Check camera"), problem().isEmpty());
  changeScreen_->show(tr("Change the screen"));
  changePrograms_->show(tr("Change the programs"));
  remove_->show(tr("Move to the trash"));
  keepVenue_->show(tr("Keep it"));
  allowPrograms_->show(tr("Allow them"));
  openWithout_->show(tr("Open without them"));
}

PageCommand* VenuePage::primary() const {
  if (mode_ == Mode::start) return session_.isOpen() ? continue_ : nullptr;
  if (mode_ == Mode::programs) return usePrograms_;
  return mode_ == Mode::screen ? useScreen_ : begin_;
}

std::vector<PageCommand*> VenuePage::secondary() const {
  if (mode_ != Mode::start) return {};
  std::vector<PageCommand*> commands;
  // Where it is missing, the banner has the same.
  if (openScreen_.isChangeable() && !openScreen_.isMissing()) commands.push_back(changeScreen_);
  if (openPrograms_.isChangeable()) commands.push_back(changePrograms_);
  return commands;
}

std::optional<Banner> VenuePage::banner() const {
  if (mode_ == Mode::devices)
    for (const pipeline::ScreenRigSettings::Screen& screen : projectors())
      if (const QString connector = QString::fromStdString(screen.display.connector);
          VenueUse::isTaken(VenueUse::ofScreen(connector), VenueUse::Way::screen))
        return Banner{
            Banner::Kind::amber, tr("A show plays on %1").arg(connector),
            tr("Another program shows it. End it before anything is measured there: Camera has the button.")};
  if (mode_ != Mode::start || !openScreen_.isChangeable() || !openScreen_.isMissing()) return std::nullopt;
  return Banner{
      Banner::Kind::amber,
      tr("The projector's screen %1 is not there")
          .arg(QString::fromStdString(session_.screenOf(*openScreen_.missing())->display.connector)),
      tr("Plug it in, or say which screen the projector is now."), changeScreen_};
}

bool VenuePage::goBack() {
  if (mode_ == Mode::start) return false;
  setMode(Mode::start);
  return true;
}

void VenuePage::setRoomClear(bool clear) {
  roomClear_ = clear;
  tellSettings();
}

void VenuePage::setMode(Mode mode) {
  mode_ = mode;
  roomClear_ = false;
  openScreen_.forget();
  openPrograms_.forget();
  if (mode != Mode::start) suggestName();
  if (mode == Mode::devices) {
    session_.letGoOfDevices();  // else its camera would be said to be another program's
    finder_.look();
  }
  tellSettings();
}

bool VenuePage::isOpenNow(const RecentVenue& venue) const {
  return session_.isOpen() &&
         QDir::cleanPath(QString::fromStdString(session_.path().string())) == venue.folder;
}

QString VenuePage::tidyProblem() const {
  return VenueTidy::problem(session_);
}

std::unique_ptr<VenueTidy> VenuePage::tidy(const RecentVenue& venue) {
  return std::make_unique<VenueTidy>(session_, stepName, venue.folder);
}

void VenuePage::rename(const RecentVenue& venue, const QString& name) {
  QString why = keeping_.whyNotRenamed(venue);
  if (why.isEmpty()) why = VenueKeeping::nameProblem(venue, name);
  if (!why.isEmpty())
    return Q_EMIT failed({{ErrorKind::input, why, tr("Try again then."), {}}, tr("Nothing was changed.")});
  try {
    keeping_.rename(venue, name);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing of the venue is lost.")});
  }
  tellSettings();
}

void VenuePage::askToRemove(const RecentVenue& venue) {
  toRemove_ = venue;
  FailureReport question;
  question.failure.heading = tr("Remove a venue");
  question.failure.what =
      tr("“%1” goes to the trash, with its photographs, results and playlist.").arg(venue.name);
  question.safe = tr("Until the trash is emptied it can be taken back from there.");
  question.goOn = remove_;
  question.resume = keepVenue_;
  question.isQuestion = true;
  Q_EMIT failed(question);
}

void VenuePage::removeAsked() {
  const RecentVenue venue = std::exchange(toRemove_, {});
  // What has become of it since it was asked.
  if (const QString why = keeping_.whyNotRemoved(venue); !why.isEmpty())
    return Q_EMIT failed({{ErrorKind::input, why, tr("Try again then."), {}}, tr("Nothing was changed.")});
  try {
    keeping_.remove(venue);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing of the venue is lost.")});
  }
  tellSettings();
}

void VenuePage::open(const QString& path) {
  QFileInfo file(path);
  bool within = file.isFile() && file.fileName() == manifestName;
  QDir folder(within ? file.path() : path);
  if (folder.exists() && !folder.exists(manifestName)) return reportNoVenue(folder);
  whenNothingEnds([this, venue = folder.path()] { openNow(venue); });
}

void VenuePage::openNow(const QString& folder) {
  try {
    const std::vector<std::string> commands = devices::withoutConsent(commandsIn(folder.toStdString()));
    if (!commands.empty()) return askForPrograms(folder, commands);
    session_.open(folder.toStdString());
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed in that folder.")});
  }
}

void VenuePage::askForPrograms(const QString& folder, const std::vector<std::string>& commands) {
  toOpen_ = folder;
  programs_ = commands;
  QStringList lines;
  for (const std::string& command : commands) lines << visibleText(command);
  FailureReport question;
  question.failure.heading = tr("Programs of a venue");
  question.failure.what = tr("“%1” names programs of its own as projector or camera. They would run on this "
                             "computer as you, and nobody here has agreed to that yet:")
                              .arg(QDir(folder).dirName()) +
                          "\n\n" + lines.join("\n");
  question.safe =
      tr("None of them was run. Without them everything that was measured can be looked at and shown.");
  question.failure.advice = tr("Allow them if you know what they do, or know who made this venue.");
  question.goOn = allowPrograms_;
  question.resume = openWithout_;
  question.isQuestion = true;
  Q_EMIT failed(question);
}

void VenuePage::openAsked(bool allowed) {
  try {
    if (allowed) devices::giveConsent(programs_);
    session_.open(toOpen_.toStdString());
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed in that folder.")});
  }
}

void VenuePage::whenNothingEnds(std::function<void()> work) {
  endQuestion_.whenNothingEnds(std::move(work),
                               [this](const FailureReport& question) { Q_EMIT failed(question); });
}

void VenuePage::reportNoVenue(const QDir& folder) {
  int within = 0;
  for (const QString& child : folder.entryList(QDir::Dirs | QDir::NoDotAndDotDot))
    if (folder.exists(child + '/' + manifestName)) ++within;
  Failure failure{ErrorKind::input,
                  tr("%1 is not the folder of a venue: it has no %2 in it.").arg(folder.path(), manifestName),
                  within > 0 ? tr("There are %n venue(s) within it: open one of them.", nullptr, within)
                             : tr("Choose a venue's own folder. It has the venue's name."),
                  folder.path(), tr("This folder is not a venue")};
  Q_EMIT failed({failure, tr("Nothing was changed in that folder.")});
}

void VenuePage::setScript(const pipeline::CommandRigSettings& script) {
  script_ = script;
  tellSettings();
}

void VenuePage::chooseScriptScreen(const ScreenChoice& choice) {
  scriptScreen_ = choice;
  script_.projector = choice.size;
  tellSettings();
}

bool VenuePage::isScriptOnScreen() const {
  return mode_ == Mode::script && scriptScreen_ &&
         QString::fromStdString(script_.projectorCommand).trimmed().isEmpty();
}

void VenuePage::setVenueName(const QString& name) {
  venueName_ = name;
  named_ = !name.isEmpty();
  tellSettings();
}

void VenuePage::setFolder(const QString& folder) {
  parent_ = QDir::cleanPath(folder);
  suggestName();
  tellSettings();
}

void VenuePage::setUsualFolder(const QString& folder) {
  if (std::exchange(usualFolder_, folder) != folder) setFolder(folder);
}

/// A name that is not taken yet.
void VenuePage::suggestName() {
  if (named_) return;
  QString base = isReal() ? tr("New venue") : tr(venues_[venue_].name);
  venueName_ = base;
  for (int number = 2; QFileInfo::exists(target()); ++number)
    venueName_ = QString("%1 %2").arg(base).arg(number);
}

void VenuePage::use(const std::function<void()>& apply) {
  if (!problem().isEmpty()) return;
  try {
    apply();
    setMode(Mode::start);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed.")});
  }
}

void VenuePage::begin() {
  if (isOfOpenVenue() || !problem().isEmpty()) return;
  whenNothingEnds([this] { beginNow(); });
}

void VenuePage::beginNow() {
  try {
    QDir().mkpath(parent_);
    bool clear = roomClear_;  // begun, the page starts over
    // Whoever types a command agrees to it.
    devices::giveConsent(pipeline::commandsOf(wanted().rig));
    session_.begin(target().toStdString(), wanted(), surprisesWanted());
    session_.setRoomClear(clear);
    network_.clear();
    named_ = false;
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was measured yet.")});
  }
}

}  // namespace relucent::gui
