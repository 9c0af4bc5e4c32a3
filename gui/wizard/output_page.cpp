// SPDX-License-Identifier: MIT
#include "wizard/output_page.h"

#include <QCoreApplication>
#include <QDesktopServices>
#include <QFileInfo>
#include <QGuiApplication>
#include <QScreen>
#include <QStandardPaths>
#include <QUrl>

#include "base/error.h"
#include "output/installation.h"
#include "wizard/preview_page.h"

namespace relucent {

OutputPage::OutputPage(Session& session, QObject* parent)
    : DevicePage(session, parent),
      proof_(session, [this] { return name(); }),
      config_(QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation)) {
  connect(&session_, &Session::opened, this, [this] {
    close();
    projection_.mirrorProjector(projector());
    preferred_ = QString::fromStdString(session_.settings().content.picture);
    playlist_.open(session_.isOpen() ? QString::fromStdString(session_.path().string()) : QString(),
                   preferred_);
  });
  connect(&session_, &Session::changed, this, [this] {
    QString picture = QString::fromStdString(session_.settings().content.picture);
    if (session_.isOpen() && std::exchange(preferred_, picture) != picture) playlist_.prefer(picture);
    if (chosen_.size() != projectors()) return listScreens();
    Q_EMIT changed();
  });
  connect(&playlist_, &OutputPlaylist::unreadable, this, [this](const QString& sentence) {
    tell({ErrorKind::format, sentence, tr("Make the list again."), sentence});
  });
  connect(&playlist_, &OutputPlaylist::changed, this, &OutputPage::changed);
  connect(&proof_, &OutputProof::changed, this, &OutputPage::changed);
  connect(&proof_, &OutputProof::ended, this, &OutputPage::proofEnded);
  connect(&proof_, &OutputProof::failed, this, &OutputPage::tell);
  connect(&proof_, &OutputProof::reported, this,
          [](const QString& file) { QDesktopServices::openUrl(QUrl::fromLocalFile(file)); });
  connect(&projection_, &OutputProjection::changed, this, &OutputPage::changed);
  connect(&projection_, &OutputProjection::failed, this, &OutputPage::tell);
  connect(qApp, &QGuiApplication::screenAdded, this, &OutputPage::listScreens);
  connect(qApp, &QGuiApplication::screenRemoved, this, &OutputPage::listScreens);
  listScreens();
}

OutputPage::~OutputPage() {
  finish();
}

void OutputPage::finish() {
  reopen_ = false;
  proof_.cancel();
  close();
}

void OutputPage::listScreens() {
  std::vector<std::optional<ScreenIdentity>> before;
  for (const auto& screen : chosen_)
    before.push_back(screen ? std::optional(screens_[*screen].identity) : std::nullopt);
  screens_.clear();
  for (QScreen* screen : QGuiApplication::screens())
    screens_.push_back(
        {identityOf(*screen), nativeSize(*screen), screen == QGuiApplication::primaryScreen()});
  chosen_.assign(session_.projectors(), std::nullopt);
  for (std::size_t projector = 0; projector < std::min(chosen_.size(), before.size()); ++projector)
    for (std::size_t i = 0; i < screens_.size(); ++i)
      if (before[projector] && screens_[i].identity == *before[projector]) chosen_[projector] = i;
  // One that has just been unplugged is not replaced unasked.
  for (std::size_t projector = 0; projector < chosen_.size(); ++projector)
    if (projector >= before.size() || !before[projector]) chooseFreeScreen(projector);
  Q_EMIT changed();
}

/// The first that is neither the operator's nor another projector's.
void OutputPage::chooseFreeScreen(std::size_t projector) {
  for (std::size_t i = 0; i < screens_.size(); ++i) {
    bool taken = std::find(chosen_.begin(), chosen_.end(), std::optional(i)) != chosen_.end();
    if (taken || screens_[i].operators) continue;
    chosen_[projector] = i;
    return;
  }
}

void OutputPage::choose(std::size_t index) {
  if (isOpen()) close();
  std::optional<std::size_t>& mine = chosen_[projector()];
  auto other = std::find(chosen_.begin(), chosen_.end(), std::optional(index));
  if (other != chosen_.end()) *other = mine;
  mine = index;
  Q_EMIT changed();
}

std::optional<std::size_t> OutputPage::projectorWithoutScreen() const {
  auto missing = std::find(chosen_.begin(), chosen_.end(), std::nullopt);
  if (missing == chosen_.end()) return std::nullopt;
  return static_cast<std::size_t>(missing - chosen_.begin());
}

QString OutputPage::missingScreen(std::size_t projector) const {
  if (projectors() == 1) return tr("Choose the projector's screen.");
  if (screens_.size() < projectors())
    return tr("Each of the %n projector(s) needs a screen of its own. Plug in another one.", nullptr,
              static_cast<int>(projectors()));
  return tr("Choose a screen for projector %1.").arg(projector + 1);
}

void OutputPage::enter() {
  listScreens();
}

StepStatus OutputPage::status() const {
  if (isOpen()) return {StepState::busy, isBlack() ? tr("Black") : isFrozen() ? tr("Frozen") : tr("Playing")};
  return {};
}

QString OutputPage::hint() const {
  if (projection_.isOpening()) return projection_.stage();
  if (proof_.work() != OutputProof::Work::none) return proof_.stage();
  if (playlist_.isEmpty()) return tr("Add a picture or a film to the playlist.");
  if (auto missing = projectorWithoutScreen()) return missingScreen(*missing);
  if (isOpen())
    return proof_.proof() ? tr("Playing. Hold A to compare.")
                          : tr("Take a verification photograph, or install without proof.");
  if (screens_.size() < 2)
    return tr("There is one screen only. The output will cover it; Esc closes the output.");
  return tr("Nothing is projected before you open the output.");
}

Command OutputPage::primary() const {
  auto* self = const_cast<OutputPage*>(this);
  if (isOpen())
    return {proof_.proof() ? tr("Install show") : tr("Install without proof"),
            Icon::power,
            !playlist_.isEmpty(),
            {},
            [self] { self->install(); }};
  return {tr("Open output"),
          Icon::play,
          !projectorWithoutScreen() && !playlist_.isEmpty() && !projection_.isOpening() &&
              session_.busy().isEmpty(),
          {},
          [self] { self->open(); }};
}

std::vector<Command> OutputPage::secondary() const {
  auto* self = const_cast<OutputPage*>(this);
  if (!isOpen()) return {};
  return {{isFrozen() ? tr("Play") : tr("Freeze"), isFrozen() ? Icon::play : Icon::pause, true,
           QKeySequence("Ctrl+P"), [self] { self->setFrozen(!self->isFrozen()); }},
          {isBlack() ? tr("Show again") : tr("Black"), Icon::black, true, QKeySequence("Ctrl+B"),
           [self] { self->setBlack(!self->isBlack()); }},
          {tr("Close output"), Icon::stop, true, {}, [self] { self->close(); }}};
}

std::optional<double> OutputPage::progress() const {
  if (projection_.isOpening()) return projection_.fraction();
  return proof_.work() != OutputProof::Work::none ? std::optional(proof_.fraction()) : std::nullopt;
}

void OutputPage::setPlaylist(const PlaylistSettings& settings) {
  try {
    playlist_.set(settings);
  } catch (...) {
    tell(failureOf(std::current_exception()));
  }
  if (playlist_.isEmpty())
    close();
  else
    projection_.setList(settings);
}

void OutputPage::edit(const QString& what, const PlaylistSettings& after) {
  if (after == playlist_.settings()) return;
  changeUndoably(what, playlist_.settings(), after,
                 [this](const PlaylistSettings& settings) { setPlaylist(settings); });
}

void OutputPage::addFiles(const QStringList& files) {
  edit(tr("Add to the playlist"), playlist_.withAdded(files));
}

void OutputPage::removeItem(qsizetype index) {
  edit(tr("Remove from the playlist"), playlist_.without(index));
}

void OutputPage::moveItem(qsizetype index, qsizetype by) {
  edit(tr("Order of the playlist"), playlist_.withMoved(index, by));
}

void OutputPage::setRepeat(bool repeat) {
  PlaylistSettings after = playlist_.settings();
  after.loop = repeat;
  edit(tr("Repeat"), after);
}

void OutputPage::setFade(double seconds) {
  PlaylistSettings after = playlist_.settings();
  after.fadeSeconds = seconds;
  edit(tr("Cross-fade"), after);
}

QString OutputPage::stillMethod() const {
  const std::string& method = session_.settings().content.method;
  return method == toString(Method::refined) ? QString() : methodName(method);
}

void OutputPage::open() {
  if (isOpen() || projection_.isOpening() || projectorWithoutScreen() || playlist_.isEmpty() ||
      !session_.busy().isEmpty())
    return;
  std::vector<ScreenIdentity> screens;
  for (const auto& screen : chosen_) screens.push_back(screens_[*screen].identity);
  projection_.open({session_.path(), playlist_.settings(), session_.settings().content.fit, screens});
}

void OutputPage::close() {
  projection_.close();
}

void OutputPage::whileClosed(const std::function<void()>& work) {
  if (!proof_.isPossible() || projection_.isOpening()) return;
  // A real camera would photograph the show.
  if (isOpen() && !session_.isSimulated()) {
    close();
    reopen_ = true;
  }
  work();
}

void OutputPage::verify() {
  whileClosed([this] { proof_.photograph(pictureToProve()); });
}

void OutputPage::proofEnded() {
  if (std::exchange(reopen_, false)) open();
}

QString OutputPage::pictureToProve() const {
  const QList<PlaylistItem>& items = playlist_.settings().items;
  qsizetype now = projection_.playing();
  if (now >= 0 && now < items.size() && OutputPlaylist::isStill(items[now])) return items[now].path;
  auto still = std::find_if(items.begin(), items.end(), OutputPlaylist::isStill);
  return still != items.end() ? still->path : ownPicture();
}

void OutputPage::report() {
  if (proof_.isPossible()) proof_.report(pictureToProve());
}

void OutputPage::setStartsWithComputer(bool starts) {
  starts_ = starts;
  Q_EMIT changed();
}

bool OutputPage::isInstalled() const {
  return relucent::isInstalled(Start::service, config_) || relucent::isInstalled(Start::autostart, config_);
}

QStringList OutputPage::showArguments() const {
  Canvas canvas =
      isOpen() ? projection_.canvas() : OutputProjection::canvasFor(playlist_.settings(), Fit::fit);
  QStringList arguments{"show",      QString::fromStdString(session_.path().string()),
                        "--content", playlist_.file(),
                        "--canvas",  QString("%1x%2").arg(canvas.size.width()).arg(canvas.size.height()),
                        "--log",     QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)};
  // One for each projector, or by their sizes.
  QStringList connectors;
  for (const auto& screen : chosen_)
    if (screen && !screens_[*screen].identity.connector.isEmpty())
      connectors << screens_[*screen].identity.connector;
  if (static_cast<std::size_t>(connectors.size()) == projectors())
    for (const QString& connector : connectors) arguments << "--screen" << connector;
  return arguments;
}

void OutputPage::install() {
  try {
    playlist_.save();
    if (starts_)
      // Where systemd does not run the session, the desktop starts it.
      relucent::install(QFileInfo::exists("/run/systemd/system") ? Start::service : Start::autostart, config_,
                        QCoreApplication::applicationFilePath(), showArguments());
    else
      for (Start start : {Start::service, Start::autostart}) uninstall(start, config_);
  } catch (...) {
    tell(failureOf(std::current_exception()));
  }
  Q_EMIT changed();
}

void OutputPage::tell(const Failure& failure) {
  Q_EMIT failed({failure, tr("The calibration is as it was."), {}, {}});
}

}  // namespace relucent
