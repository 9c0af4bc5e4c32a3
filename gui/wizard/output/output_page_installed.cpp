// SPDX-License-Identifier: MIT
// The show that starts at log-in, as Output installs and removes it.
#include <QCoreApplication>
#include <QFileInfo>
#include <QStandardPaths>
#include <utility>

#include "output/installation.h"
#include "wizard/output/output_page.h"

namespace relucent::gui {
namespace {

constexpr const char* nightFormat = "HH:mm";  // of --night

}  // namespace

void OutputPage::setConfigFolder(const QString& folder) {
  config_ = folder;
  detectInstalledShow();
}

void OutputPage::detectInstalledShow() {
  const QString venue = QString::fromStdString(session_.path().string());
  installed_ = InstalledShow::none;
  for (Start start : {Start::service, Start::autostart}) {
    if (session_.isOpen() && gui::isInstalled(start, config_, venue)) {
      installed_ = InstalledShow::thisVenues;
      installedAt_ = installedAt(start, config_);
      nightAt_ = QTime::fromString(installedValue(start, config_, "--night"), nightFormat);
    } else if (installed_ == InstalledShow::none && gui::isInstalled(start, config_)) {
      installed_ = InstalledShow::anotherVenues;
    }
  }
  tellResult();
}

QStringList OutputPage::showArguments() const {
  Canvas canvas = isOpen() ? projection_.canvas()
                           : OutputProjection::canvasFor(playlist_.settings(), compensation::Fit::fit);
  QStringList arguments{"show",      QString::fromStdString(session_.path().string()),
                        "--content", playlist_.file(),
                        "--canvas",  QString("%1x%2").arg(canvas.size.width()).arg(canvas.size.height()),
                        "--log",     QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)};
  if (nightAt_.isValid()) arguments << "--night" << nightAt_.toString(nightFormat);
  // One for each projector, or by their sizes.
  QStringList connectors;
  for (const auto& screen : chosen_)
    if (screen && !screens_[*screen].identity.connector.isEmpty())
      connectors << screens_[*screen].identity.connector;
  if (static_cast<std::size_t>(connectors.size()) == projectors())
    for (const QString& connector : connectors) arguments << "--screen" << connector;
  return arguments;
}

void OutputPage::setNightAt(QTime time) {
  if (std::exchange(nightAt_, time) == time) return;
  if (isInstalled())
    install();
  else
    tellSettings();
}

void OutputPage::install() {
  if (!isInstallable() || playlist_.isEmpty()) return detectInstalledShow();
  try {
    playlist_.save();
    // Where systemd does not run the session, the desktop starts it.
    gui::install(QFileInfo::exists("/run/systemd/system") ? Start::service : Start::autostart, config_,
                 QCoreApplication::applicationFilePath(), showArguments());
  } catch (...) {
    tell(failureOf(std::current_exception()));
  }
  detectInstalledShow();
}

void OutputPage::askToRemoveInstalled() {
  removeShow_->show(tr("Remove"));
  keepShow_->show(tr("Keep"));
  FailureReport question;
  question.failure.heading = tr("Remove installed show");
  question.failure.what = installed_ == InstalledShow::anotherVenues
                              ? tr("The show of another venue will no longer start at log-in.")
                              : tr("The show of this venue will no longer start at log-in.");
  question.safe = tr("Venue and playlist stay. It can be installed again from its venue's Output.");
  question.resume = keepShow_;
  question.goOn = removeShow_;
  question.isQuestion = true;
  Q_EMIT failed(question);
}

void OutputPage::removeInstalled() {
  try {
    for (Start start : {Start::service, Start::autostart}) uninstall(start, config_);
  } catch (...) {
    tell(failureOf(std::current_exception()));
  }
  detectInstalledShow();
}

}  // namespace relucent::gui
