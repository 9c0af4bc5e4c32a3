// SPDX-License-Identifier: MIT
#pragma once

#include "jobs/latest.h"
#include "relucent/transport/footprint.h"
#include "relucent/transport/matrix_density.h"
#include "relucent/transport/statistics.h"
#include "wizard/devices/device_page.h"

namespace relucent::gui {

/// Step 5: the faintest light that is worth keeping.
class ThresholdPage : public DevicePage {
  Q_OBJECT

 public:
  static constexpr StepName stepName{"threshold", "relucent::gui::ThresholdPage",
                                     QT_TRANSLATE_NOOP("relucent::gui::ThresholdPage", "Threshold")};

  explicit ThresholdPage(Session& session, QObject* parent = nullptr);

  QString subtitle() const override {
    return tr(
        "Choose the faintest light worth keeping. Less is faster and smaller; too little loses the bounces.");
  }
  StepStatus status() const override;
  QString hint() const override;
  /// Why nothing is to be seen of the measurement: it is still being read, or cannot be.
  QString whyNothing() const;
  QString whyLocked() const override { return session_.whyLocked(step()); }
  PageCommand* primary() const override { return accept_; }
  std::optional<Banner> banner() const override;
  bool isChanged() const override;
  void enter() override;
  void leave() override { isLookedAt_ = false; }

  std::shared_ptr<const transport::Acquisition> acquisition() const { return session_.acquisition(); }
  /// The surface in full light, in every camera's view, of the measurement that is used; there long before
  /// acquisition(). Null: not read yet.
  std::shared_ptr<const std::vector<image::Image>> floodlights() const { return floodlights_.second; }
  /// Of everything that was measured; none while it is being read.
  const std::optional<transport::TransportStatistics>& whole() const { return whole_; }
  /// Of what the cut leaves; follows the cut. At first as the histogram of the whole has it, where that
  /// knows, then counted.
  const std::optional<transport::TransportStatistics>& kept() const { return kept_; }
  bool isExact() const { return kept_.has_value() && !statistics_.isBusy(); }
  /// Connections below the cut stay, as they are the strongest of their camera pixel.
  bool isStrongestKept() const;
  /// Three times the noise of the measurement, where that costs no light. Else nothing is cut: faint light
  /// adds up (core/transport/README.md, "What a cut costs").
  double suggested() const { return suggested_; }
  /// suggested() is what the noise says.
  bool isNoiseSuggested() const { return suggested_ > 0.0 && noise_.has_value(); }
  /// A cut at three times the noise, and the share of the light that it would keep.
  struct NoiseCut {
    double cut = 0.0, keeps = 1.0;
  };
  /// None: the measurement does not know its noise.
  const std::optional<NoiseCut>& noise() const { return noise_; }

  const transport::ThresholdSettings& cut() const { return cut_; }
  bool isShareOfPixel() const { return shareOfPixel_; }
  void setShareOfPixel(bool share);
  void setAbsolute(double cut);
  void setShare(double share);
  void useSuggested() { setAbsolute(suggested_); }
  /// The light of the picked connection; none where nothing or no light is picked.
  std::optional<double> pickedLight() const;
  /// What is picked is the faintest that stays.
  void usePicked();

  /// Pictures of what the cut leaves of T; follows the cut.
  const std::shared_ptr<const transport::MatrixPictures>& matrix() const { return matrix_; }

  /// A pixel of the shown camera that is looked at, and where its light comes from: its row of T.
  /// The shown projector's strongest pixel is then looked at as well.
  void pick(Pixel pixel);
  const std::optional<Pixel>& picked() const { return picked_; }
  const std::shared_ptr<const transport::PixelFootprint>& footprint() const { return footprint_; }
  /// A pixel of the shown projector that is looked at, and what it lights: its column of T.
  void pickProjector(Pixel pixel);
  const std::optional<Pixel>& pickedProjector() const { return pickedProjector_; }
  const std::shared_ptr<const std::vector<float>>& lit() const { return lit_; }
  /// Both at once: an entry of T. Its camera and projector are shown from now on.
  void pickEntry(std::size_t row, std::size_t column);
  /// What is picked as an entry of T; none while anything is missing.
  std::optional<std::size_t> pickedRow() const;
  std::optional<std::size_t> pickedColumn() const;

 protected:
  void updateCommands() override;
  bool mayKeep() const override { return isExact() && DevicePage::mayKeep(); }
  void keepChange() override { keepCut(); }

 private:
  void takeSettings();
  void wantMeasurement();
  void adopt();
  void forget();
  void lookAtRow();
  void lookAtColumn();
  void followFootprint();
  void projectorChanged() override;
  void cameraChanged() override;
  void compute();
  void suggest(const transport::TransportStatistics& whole);
  void accept();
  bool keepCut();
  /// What is decided here, as it is undone.
  struct Choice {
    transport::ThresholdSettings cut;
    bool isShareOfPixel = false;
  };
  void change(const QString& what, const Choice& after);
  void take(const Choice& choice);

  /// With the measurement's name.
  using Floodlights = std::pair<std::string, std::shared_ptr<const std::vector<image::Image>>>;

  PageCommand *accept_, *goOnMeasuring_;
  Floodlights floodlights_;
  std::shared_ptr<const transport::Acquisition> adopted_;
  transport::ThresholdSettings cut_;
  bool shareOfPixel_ = false, isLookedAt_ = false;
  float absoluteBefore_ = 0.0f, shareBefore_ = 0.0f;  // of the way that is not used now
  std::optional<transport::TransportStatistics> whole_, kept_;
  double suggested_ = 0.0;
  std::optional<NoiseCut> noise_;
  std::optional<Pixel> picked_, pickedProjector_;
  std::shared_ptr<const transport::PixelFootprint> footprint_;
  std::shared_ptr<const std::vector<float>> lit_;
  std::shared_ptr<const transport::MatrixPictures> matrix_;
  bool follows_ = false;  // the projector's pixel is to be the picked row's strongest in that projector
  Latest<transport::TransportStatistics> statistics_, first_;
  Latest<std::shared_ptr<const transport::PixelFootprint>> looking_;
  Latest<std::shared_ptr<const std::vector<float>>> lighting_;
  Latest<std::shared_ptr<const transport::MatrixPictures>> picturing_;
  Latest<Floodlights> lightening_;
};

}  // namespace relucent::gui
