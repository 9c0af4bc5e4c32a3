// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "relucent/pipeline/screen_devices.h"
#include "wizard/devices/camera_finder.h"
#include "wizard/devices/screen_choice.h"
#include "wizard/frame/end_question.h"
#include "wizard/frame/page_model.h"
#include "wizard/session/session.h"
#include "wizard/venue/recent_venues.h"
#include "wizard/venue/venue_keeping.h"
#include "wizard/venue/venue_network.h"
#include "wizard/venue/venue_programs.h"
#include "wizard/venue/venue_screen.h"

class QDir;

namespace relucent::gui {

class VenueTidy;

/// How much there is to understand in a simulated venue.
enum class Difficulty { easy, usual, hard };

/// A simulated venue as it is offered.
struct RehearsalVenue {
  std::string id;               // core's name
  const char *name, *sentence;  // for VenuePage::tr()
  QString picture;              // resource
  Difficulty difficulty = Difficulty::usual;
};
/// Sizes of the simulated devices.
struct RehearsalSize {
  Size projector, camera;
  const char* text;  // for VenuePage::tr(), with a place for the pixels
};

/// Step 1: which venue, and where its work is kept.
class VenuePage : public PageModel {
  Q_OBJECT

 public:
  static constexpr StepName stepName{"venue", "relucent::gui::VenuePage",
                                     QT_TRANSLATE_NOOP("relucent::gui::VenuePage", "Venue")};

  enum class Mode { start, rehearse, script, devices, screen, programs };
  /// What has to be changed before the venue can begin.
  enum class Remedy { none, name, folder, screen, consent };

  VenuePage(Session& session, RecentVenues recent, QObject* parent = nullptr);

  QString title() const override;
  QString subtitle() const override;
  StepStatus status() const override;
  QString hint() const override;
  bool hasRemedy() const override { return remedy() != Remedy::none; }
  PageCommand* primary() const override;
  std::vector<PageCommand*> secondary() const override;
  std::optional<Banner> banner() const override;
  bool goBack() override;
  bool canGoBack() const override { return mode_ != Mode::start; }
  bool usesInspector() const override { return mode_ != Mode::start; }

  Mode mode() const { return mode_; }
  /// What is chosen is for the calibration that is open, not for a new one.
  bool isOfOpenVenue() const { return mode_ == Mode::screen || mode_ == Mode::programs; }
  void setMode(Mode mode);
  QList<RecentVenue> recent() const { return recent_.list(); }
  bool isOpenNow(const RecentVenue& venue) const;
  /// A calibration's folder, or its file in there. Tells failed() if it cannot be opened. Where a measurement
  /// or a show would end by it, asks first.
  void open(const QString& path);

  /// Why no venue can be tidied now, a sentence; empty: it can.
  QString tidyProblem() const;
  /// Of a venue that was opened before; see VenueTidy.
  std::unique_ptr<VenueTidy> tidy(const RecentVenue& venue);

  /// What another name and the trash are for.
  VenueKeeping& keeping() { return keeping_; }
  /// Tells failed() where it cannot be done.
  void rename(const RecentVenue& venue, const QString& name);
  /// Asks first.
  void askToRemove(const RecentVenue& venue);

  const std::vector<RehearsalVenue>& venues() const { return venues_; }
  const std::vector<RehearsalSize>& sizes() const { return sizes_; }
  static QString nameOf(const RehearsalSize& size);
  std::size_t venue() const { return venue_; }
  std::size_t size() const { return size_; }
  void chooseVenue(std::size_t index);
  void chooseSize(std::size_t index);
  /// How long it takes to measure one of the venues, and how hard it is.
  QString effortOf(const RehearsalVenue& venue) const;
  /// What happens while the rehearsal measures, for practice.
  bool hasSurprise(venue::Surprise surprise) const;
  void setSurprise(venue::Surprise surprise, bool wanted);
  /// Of the moments; else another one for every rehearsal.
  void setSurpriseSeed(std::uint64_t seed) { surpriseSeed_ = seed; }
  /// Pixels of their own for tests and pictures.
  void setSizes(std::vector<RehearsalSize> sizes);

  const pipeline::CommandRigSettings& script() const { return script_; }
  void setScript(const pipeline::CommandRigSettings& script);
  /// A screen that shines there. Its pixels are the projector's.
  void chooseScriptScreen(const ScreenChoice& choice);
  /// Relucent shows the pictures on the chosen screen itself: no command is named for that.
  bool isScriptOnScreen() const;

  /// Screens of the desktop as projectors, and cameras, in the mode `devices`.
  const pipeline::ScreenRigSettings& screen() const { return screen_; }
  std::vector<pipeline::ScreenRigSettings::Screen> projectors() const { return pipeline::screensOf(screen_); }
  /// The one that chooseScreen() gives a screen to.
  std::size_t projector() const { return projector_; }
  void selectProjector(std::size_t projector);
  void chooseScreen(const ScreenChoice& choice);
  /// All that are there; those of other projectors are refused.
  std::vector<ScreenChoice> screensToChoose() const;
  /// A screen is left for another projector.
  bool mayAddProjector() const;
  /// On the first screen that is left, and selected.
  void addProjector();
  bool isPluggedIn(const pipeline::ScreenRigSettings::Screen& screen) const;
  void removeProjector(std::size_t projector);
  void nameProjector(std::size_t projector, const QString& name);

  /// Where these projectors are on the network.
  VenueNetwork& network() { return network_; }

  /// Chosen here, or at the step Camera where none is; content is placed in the first one's view.
  std::vector<pipeline::ScreenRigSettings::Camera> cameras() const { return pipeline::camerasOf(screen_); }
  CameraFinder& finder() { return finder_; }
  bool hasCamera(const std::string& address) const;
  void addCamera(const std::string& address);
  void removeCamera(const std::string& address);
  void nameCamera(std::size_t camera, const QString& name);
  /// What choosing that screen means, a sentence; empty: nothing out of the ordinary.
  QString screenWarning() const { return screenWarning_; }

  /// The screen of the calibration that is open, in the mode `screen`.
  VenueScreen& openScreen() { return openScreen_; }
  const VenueScreen& openScreen() const { return openScreen_; }
  /// The programs of the calibration that is open, in the mode `programs`.
  VenuePrograms& openPrograms() { return openPrograms_; }
  const VenuePrograms& openPrograms() const { return openPrograms_; }
  const Session& session() const { return session_; }

  /// Of the new calibration.
  QString venueName() const { return venueName_; }
  void setVenueName(const QString& name);
  QString folder() const { return parent_; }
  void setFolder(const QString& folder);
  /// Where new ones are kept as long as nobody says otherwise.
  void setUsualFolder(const QString& folder);
  std::uint64_t freeBytes() const;
  /// Before a screen is chosen nobody knows the projector's pixels.
  bool isExpectedKnown() const { return mode_ != Mode::devices || !screen_.projector.empty(); }
  /// What acquiring will about take; nobody knows how long before the devices were tried.
  WorkLeft expected() const;
  /// By a fast camera and by a slow one.
  std::pair<double, double> expectedSeconds() const;

  /// Devices of the user's, not simulated ones.
  bool isReal() const { return mode_ == Mode::script || mode_ == Mode::devices; }

  /// Devices of the user's may flash more than three times a second. Off whenever a new venue is begun.
  bool needsConsent() const { return isReal() && session_.flashLimit() == 0; }
  bool isRoomClear() const { return roomClear_; }
  void setRoomClear(bool clear);

  /// The first sentence against beginning; empty: nothing.
  QString problem() const { return firstProblem().sentence; }
  Remedy remedy() const { return firstProblem().remedy; }

 protected:
  void updateCommands() override;

 private:
  struct Problem {
    QString sentence;
    Remedy remedy = Remedy::none;
  };
  Problem firstProblem() const;
  static std::vector<RehearsalVenue> rehearsalVenues();
  pipeline::CalibrateSettings wanted() const;
  WorkLeft expectedWith(double secondsAPhotograph) const;
  WorkLeft expectedOf(const RehearsalVenue& venue) const;
  venue::SurpriseSettings surprisesWanted() const;
  void removeAsked();
  void begin();
  void openNow(const QString& folder);
  /// Nobody at this computer has agreed to some of the programs that the venue names as its devices.
  void askForPrograms(const QString& folder, const std::vector<std::string>& commands);
  void openAsked(bool allowed);
  void beginNow();
  /// At once, or once somebody has agreed to the end of what is under way.
  void whenNothingEnds(std::function<void()> work);
  /// What was chosen for the venue that is open.
  void use(const std::function<void()>& apply);
  void reportNoVenue(const QDir& folder);
  void suggestName();
  QString target() const { return parent_ + '/' + venueName_; }

  Session& session_;
  RecentVenues recent_;
  VenueKeeping keeping_;
  RecentVenue toRemove_;  // somebody is asked
  QString toOpen_;        // likewise, and these are its programs
  std::vector<std::string> programs_;
  VenueScreen openScreen_;
  VenuePrograms openPrograms_;
  EndQuestion endQuestion_;
  Mode mode_ = Mode::start;
  std::vector<RehearsalVenue> venues_;
  std::vector<RehearsalSize> sizes_;
  std::size_t venue_ = 0, size_ = 0;
  std::vector<venue::Surprise> surprises_;
  std::optional<std::uint64_t> surpriseSeed_;
  pipeline::CommandRigSettings script_;
  std::optional<ScreenChoice> scriptScreen_;
  pipeline::ScreenRigSettings screen_;
  std::size_t projector_ = 0;
  CameraFinder finder_;
  VenueNetwork network_;
  QString screenWarning_;
  QString venueName_, parent_;
  QString usualFolder_;
  bool roomClear_ = false;
  bool named_ = false;  // by the user
  PageCommand *continue_, *begin_, *useScreen_, *changeScreen_, *usePrograms_, *changePrograms_;
  PageCommand *remove_, *keepVenue_, *allowPrograms_, *openWithout_;  // of a question
};

}  // namespace relucent::gui
