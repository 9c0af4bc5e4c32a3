// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/frame/page_model.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// A page that shows something of one projector and of one camera: of several, those that are chosen. The
/// first ones when a calibration is opened.
class DevicePage : public PageModel {
  Q_OBJECT

 public:
  DevicePage(const StepName& step, Session& session, QObject* parent = nullptr);

  Session& session() const { return session_; }
  std::size_t projectors() const { return session_.projectors(); }
  std::size_t cameras() const { return session_.cameras(); }
  /// Which is shown.
  std::size_t projector() const { return projector_; }
  std::size_t camera() const { return camera_; }
  /// Where there is no such device, the one of before stays.
  void showProjector(std::size_t projector);
  void showCamera(std::size_t camera);

 protected:
  /// Of a page whose work lights the projectors: while a show plays on them, that it would be covered.
  std::optional<Banner> overTheShow() const;
  /// Of any page that lights them: that another program does, too, and how that ends.
  std::optional<Banner> besideAnotherShow() const;
  void updateCommands() override;
  /// Another one is shown now; before settingsChanged() tells.
  virtual void projectorChanged() {}
  virtual void cameraChanged() {}

  Session& session_;

 private:
  void askToEndShow();
  PageCommand *endShow_, *endShowNow_, *letItPlay_;
  std::unique_ptr<QObject> endingShow_;  // while it is asked whether to
  std::size_t projector_ = 0, camera_ = 0;
};

}  // namespace relucent::gui
