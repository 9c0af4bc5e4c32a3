// SPDX-License-Identifier: MIT
#pragma once

#include <QtTest>
#include <filesystem>
#include <functional>
#include <memory>
#include <variant>

#include "gui/wizard/simulated_session.h"
#include "output/default_picture.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/settings_json.h"
#include "wizard/output/output_page.h"

namespace relucent::gui {

/// The page Output on a plain wall that was measured once for all of a class's tests, with the projector on
/// DUMMY1 of tests/support/with-two-screens. Base of a class of tests.
class OutputOnVenue {
 protected:
  SimulatedSession own_;
  std::unique_ptr<OutputPage> page_;

  void measureOnce() {
    Progress silent;
    pipeline::calibrate(own_.path("measured"), smallVenue({48, 36}, {40, 30}, 5), own_.path("cache"), silent);
  }
  void begin() {
    std::filesystem::remove_all(own_.path("venue"));
    std::filesystem::copy(own_.path("measured"), own_.path("venue"),
                          std::filesystem::copy_options::recursive);
    page_ = std::make_unique<OutputPage>(session());
    session().open(own_.path("venue"));
    page_->choose(screen("DUMMY1"));
    QVERIFY(QFile::exists(defaultPicture()) && !page_->playlist().isEmpty());
  }
  void end() {
    page_.reset();
    session().close();
  }

  Session& session() { return own_.session; }
  std::size_t screen(const QString& connector) const {
    std::size_t index = 0;
    while (page_->screens().at(index).identity.connector != connector) ++index;
    return index;
  }
  void openOutput() {
    page_->open();
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen() && !page_->projection().onProjector().isNull(), patience);
  }
  bool offersProof() const {
    return page_->mayProve() && page_->primary()->text() == OutputPage::tr("Take verification photograph");
  }
  bool isIdle() const { return page_->proof().work() == OutputProof::Work::none; }
  /// The venue, after it was measured: its results stay those of the venue as it was.
  void becomes(const std::function<void(venue::Changes&)>& change) {
    const std::filesystem::path path = session().path();
    session().close();
    {
      using namespace calibration;
      CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
      auto rig = std::get<venue::VenueSettings>(pipeline::settingsOf(folder).rig);
      change(rig.changes);
      folder.setRig(pipeline::rigToJson(rig));
      for (Stage stage : allValues<Stage>()) folder.takeAsCurrent(stage, fingerprintOf(folder, stage));
    }
    session().open(path);
    page_->choose(screen("DUMMY1"));
  }
  template <typename Change>
  void change(Change apply) {
    pipeline::CalibrateSettings settings = session().settings();
    apply(settings);
    session().changeSettings(settings);
  }
};

}  // namespace relucent::gui
