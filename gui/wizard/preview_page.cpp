// SPDX-License-Identifier: MIT
#include "wizard/preview_page.h"

#include <QFileInfo>
#include <QImage>
#include <cmath>
#include <limits>

#include "base/stopwatch.h"
#include "compensation/uncorrectable.h"
#include "image/color.h"
#include "image/picture_files.h"
#include "pipeline/measuring.h"
#include "pipeline/stages.h"
#include "views/number_text.h"

namespace relucent {
namespace {

/// What is compared; `optimum` last, it takes longest.
constexpr std::array comparedMethods{Method::none, Method::mix, Method::clusters, Method::refined,
                                     Method::optimum};

/// The picture of the settings, or the product's own where that is gone.
std::shared_ptr<const Image> contentFor(const ContentSettings& settings) {
  if (!settings.picture.empty()) {
    try {
      return std::make_shared<Image>(linearContentOf(QString::fromStdString(settings.picture)));
    } catch (const Error&) {
    }
  }
  return std::make_shared<Image>(linearContentOf(ownPicture()));
}

}  // namespace

QString methodName(std::string_view name) {
  switch (methodFromName(name).value_or(Method::refined)) {
    case Method::none:
      return PreviewPage::tr("No correction");
    case Method::scalar:
      return PreviewPage::tr("Each pixel's brightness");
    case Method::mix:
      return PreviewPage::tr("Each pixel on its own");
    case Method::sharpen:
      return PreviewPage::tr("Each pixel, sharpened");
    case Method::clusters:
      return PreviewPage::tr("Clusters");
    case Method::windows:
      return PreviewPage::tr("Windows");
    case Method::refined:
      return PreviewPage::tr("Windows and steps");
    case Method::optimum:
      break;
  }
  return PreviewPage::tr("Best possible, still pictures");
}

QString ownPicture() {
  return ":/pictures/demo.png";
}

Image linearContentOf(const QString& file) {
  if (!file.startsWith(':')) return readLinearContent(file.toStdString());
  QImage image = QImage(file).convertToFormat(QImage::Format_RGB888);
  Image encoded(Size{image.width(), image.height()}, 3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < 3 * image.width(); ++x)
      encoded.at(x / 3, y, x % 3) = static_cast<float>(image.constScanLine(y)[x]) / 255.0f;
  return srgbDecoded(encoded);
}

/// Everything that predicting needs, made once for a threshold.
struct PreviewPage::Engine {
  MeasuredCalibration measured;
  std::optional<Compensator> compensator;
};

PreviewPage::PreviewPage(Session& session, QObject* parent)
    : PageModel(parent),
      session_(session),
      computing_(
          [this](std::shared_ptr<const ContentPreview> preview) {
            preview_ = std::move(preview);
            problem_.clear();
            adoptContent(preview_->picture, preview_->content);
            if (table_.empty()) compareNext();
            Q_EMIT changed();
          },
          [this](const Failure& failure) { refuse(failure); }),
      comparing_(
          [this](std::pair<int, MethodPreview> answer) {
            if (answer.first == round_) table_.push_back(answer.second);
            compareNext();
            Q_EMIT changed();
          },
          [this](const Failure& failure) {
            Q_EMIT failed({failure, tr("What is measured is safe."), {}, {}});
          }),
      reading_(
          [this](std::pair<std::string, std::shared_ptr<const Image>> read) {
            adoptContent(read.first, read.second);
            ContentSettings after = settings_;
            after.picture = read.first;
            setSettings(after, tr("Picture"));
          },
          [this](const Failure& failure) {
            Q_EMIT failed({failure, tr("The picture of before stays."), {}, {}});
          }) {
  connect(&session_, &Session::opened, this, [this] {
    finish();
    settings_ = session_.settings().content;
    engine_ = nullptr;
    preview_ = nullptr;
    content_ = nullptr;
    problem_.clear();
    preparedFor_.clear();
    table_.clear();
    looked_ = false;
  });
  connect(&session_, &Session::changed, this, [this] {
    if (looked_) prepare();
    Q_EMIT changed();
  });
  connect(&job_, &Job::progressed, this, &PreviewPage::changed);
  connect(&job_, &Job::ended, this, &PreviewPage::prepared);
}

void PreviewPage::enter() {
  looked_ = true;
  // What failed is tried again when somebody comes back to it, not before.
  if (job_.state() == Job::State::failed) preparedFor_.clear();
  prepare();
}

void PreviewPage::prepare() {
  if (!session_.isOpen() || job_.isRunning() || !session_.busy().isEmpty()) return;
  const ThresholdSettings& cut = session_.settings().threshold;
  std::string wanted = fmt::format("{} {} {} {}", cut.absolute, cut.shareOfRowMax, cut.energyKept,
                                   session_.result(Step::acquisition)->stored);
  if (wanted == preparedFor_) return;
  preparedFor_ = wanted;
  engine_ = nullptr;
  made_ = std::make_shared<Engine>();
  session_.setBusy(name());
  job_.start([made = made_, path = session_.path()](Progress& progress) {
    {
      CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
      Progress reading = progress.part(0.2, tr("Reading the light transport").toStdString());
      MeasuredVenue venue = loadMeasuredVenue(folder, reading);
      Progress inverting = progress.part(0.5, tr("Inverting the light transport").toStdString());
      measureInverse(folder, venue, inverting);
    }
    CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
    Progress loading = progress.part(0.3, tr("Preparing the preview").toStdString());
    made->measured = loadCalibration(folder, loading);
    CompensatorSettings settings;
    settings.clustering = settingsOf(folder).clustering;
    made->compensator.emplace(made->measured.venue, made->measured.inverse, settings);
  });
  Q_EMIT changed();
}

void PreviewPage::prepared() {
  if (session_.busy() == name()) session_.setBusy({});
  if (job_.state() == Job::State::done) {
    engine_ = std::exchange(made_, nullptr);
    session_.reload();
    compute();
  } else {
    if (job_.state() == Job::State::cancelled) preparedFor_.clear();
    if (job_.state() == Job::State::failed)
      Q_EMIT failed({job_.failure(), tr("What is measured is safe."), {}, {}});
  }
  Q_EMIT changed();
}

QString PreviewPage::pictureName() const {
  return settings_.picture.empty() ? tr("Demonstration picture")
                                   : QFileInfo(QString::fromStdString(settings_.picture)).fileName();
}

void PreviewPage::choosePicture(const QString& file) {
  reading_.ask([file]() -> std::pair<std::string, std::shared_ptr<const Image>> {
    return {file.toStdString(), std::make_shared<Image>(linearContentOf(file))};
  });
}

void PreviewPage::adoptContent(const std::string& picture, std::shared_ptr<const Image> content) {
  if (contentOf_ != picture || !content_) table_.clear();
  contentOf_ = picture;
  content_ = std::move(content);
}

void PreviewPage::setSettings(const ContentSettings& settings, const QString& what) {
  changeUndoably(what, settings_, settings, [this](const ContentSettings& wanted) { adopt(wanted); });
}

void PreviewPage::adopt(const ContentSettings& settings) {
  // The methods are compared with the content in one place under one light.
  ContentSettings sameMethod = settings;
  sameMethod.method = settings_.method;
  if (sameMethod != settings_) table_.clear();
  settings_ = settings;
  problem_.clear();
  compute();
  Q_EMIT changed();
}

void PreviewPage::setCorners(const Corners& corners) {
  if (!isConvex(corners)) {
    problem_ = tr("The corners cross over. Drag them apart.");
    Q_EMIT changed();
    return;
  }
  ContentSettings after = settings_;
  after.corners = corners;
  setSettings(after, tr("Corners"));
}

void PreviewPage::placeAutomatically() {
  ContentSettings after = settings_;
  after.corners.reset();
  setSettings(after, tr("Automatic place"));
}

std::optional<Corners> PreviewPage::corners() const {
  if (settings_.corners) return settings_.corners;
  return preview_ ? std::optional(preview_->corners) : std::nullopt;
}

/// A place where nothing can be shown is no failure: the sentence stands beside the picture.
void PreviewPage::refuse(const Failure& failure) {
  if (failure.kind == ErrorKind::input)
    problem_ = failure.what + ' ' + failure.advice;
  else
    Q_EMIT failed({failure, tr("What is measured is safe."), {}, {}});
  Q_EMIT changed();
}

void PreviewPage::compute() {
  if (!engine_) return;
  ++round_;
  computing_.ask([engine = engine_, known = contentOf_ == settings_.picture ? content_ : nullptr,
                  settings = settings_]() -> std::shared_ptr<const ContentPreview> {
    Progress quiet;
    std::shared_ptr<const Image> content = known ? known : contentFor(settings);
    const MeasuredVenue& venue = engine->measured.venue;
    const Rasters& cameras = venue.transport.cameras();
    Target target = fitTarget(*content, venue, targetOf(settings));
    auto method = methodFromName(settings.method).value_or(Method::refined);
    Prediction with = predict(venue, target, engine->compensator->solve(method, target, quiet));
    Prediction without = predict(venue, target, engine->compensator->solve(Method::none, target, quiet));
    auto preview = std::make_shared<ContentPreview>();
    preview->content = content;
    preview->picture = settings.picture;
    preview->with = imageFromStack(with.camera, cameras, 0);
    preview->without = imageFromStack(without.camera, cameras, 0);
    preview->deltaE = with.deltaE;
    preview->white = target.white[0];
    preview->corners = target.corners;
    preview->reachableShare = with.reachable;
    preview->clipped = with.clipped;
    preview->deltaEMean = with.meanDeltaE;
    preview->psnr = with.psnrReachable;
    std::size_t pixels = cameras.size(0).count();
    preview->reach.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      float brightest = std::numeric_limits<float>::infinity();
      for (std::size_t c = 0; c < 3; ++c)
        brightest = std::min(brightest, venue.flood[3 * i + c] + venue.black[3 * i + c]);
      preview->reach[i] = brightest / preview->white;
    }
    preview->inside.assign(target.inside.begin(),
                           target.inside.begin() + static_cast<std::ptrdiff_t>(pixels));
    preview->reachable.assign(target.reachable.begin(),
                              target.reachable.begin() + static_cast<std::ptrdiff_t>(pixels));
    auto shares = sharesOf(uncorrectableMap(venue, target, {}, quiet));
    preview->unlit = shares[static_cast<std::size_t>(Uncorrectable::unlit)] +
                     shares[static_cast<std::size_t>(Uncorrectable::shadowed)];
    preview->tooDark = shares[static_cast<std::size_t>(Uncorrectable::tooDark)] + preview->unlit;
    preview->tooBright = shares[static_cast<std::size_t>(Uncorrectable::tooBright)];
    return preview;
  });
  Q_EMIT changed();
}

/// The table fills row by row while the pictures are there already.
void PreviewPage::compareNext() {
  if (!engine_ || !content_ || comparing_.isBusy() || table_.size() >= comparedMethods.size()) return;
  Method method = comparedMethods[table_.size()];
  comparing_.ask([engine = engine_, content = content_, settings = settings_, method, round = round_] {
    Progress quiet;
    Target target = fitTarget(*content, engine->measured.venue, targetOf(settings));
    engine->compensator->solve(Method::none, target, quiet);
    Stopwatch watch;
    Compensation compensation = engine->compensator->solve(method, target, quiet);
    double seconds = watch.seconds();
    Prediction prediction = predict(engine->measured.venue, target, compensation);
    return std::pair(round, MethodPreview{method, prediction.psnrReachable, prediction.meanDeltaE, seconds});
  });
}

StepStatus PreviewPage::status() const {
  if (job_.isRunning())
    return {session_.progress(Step::content) == StepProgress::open ? StepState::open : StepState::done,
            tr("Preparing")};
  switch (session_.progress(Step::content)) {
    case StepProgress::done:
      return {
          StepState::done,
          tr("%1 in reach").arg(percentText(session_.result(Step::content)->values.value("reachable", 0.0)))};
    case StepProgress::stale:
      return {StepState::outOfDate, tr("Out of date")};
    case StepProgress::open:
      break;
  }
  return {};
}

QString PreviewPage::hint() const {
  if (job_.isRunning()) return job_.stage();
  if (!engine_)
    return session_.busy().isEmpty() ? tr("The preview is not prepared.")
                                     : tr("The devices are in use at %1.").arg(session_.busy());
  if (!problem_.isEmpty()) return problem_;
  if (isComputing()) return tr("Predicting");
  if (!preview_) return {};
  return tr("Predicted from the measurement. Nothing is projected yet.");
}

Command PreviewPage::primary() const {
  auto* self = const_cast<PreviewPage*>(this);
  return {tr("Open output"), Icon::next, preview_ != nullptr, {}, [self] { self->accept(); }};
}

std::optional<double> PreviewPage::progress() const {
  return job_.isRunning() ? std::optional(job_.fraction()) : std::nullopt;
}

void PreviewPage::accept() {
  try {
    CalibrateSettings settings = session_.settings();
    settings.content = settings_;
    session_.changeSettings(settings);
    session_.decide(Step::content,
                    Json{{"reachable", preview_->reachableShare}, {"delta_e", preview_->deltaEMean}});
    Q_EMIT nextWanted();
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("What is measured is safe."), {}, {}});
  }
}

}  // namespace relucent
