// SPDX-License-Identifier: MIT
#include "relucent/importing/import.h"

#include <algorithm>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/importing/agreement.h"
#include "relucent/importing/response.h"
#include "relucent/importing/rows.h"
#include "relucent/importing/score.h"

namespace relucent::importing {
namespace {

constexpr int leastSpatial = 6;  // patterns with content
constexpr std::size_t sampleSize = 1500;

/// A decoded place stands for its pixel alone: what a one-to-one map knows.
std::vector<NodeShare> pixelAlone(const Decoded& decoded, Size projector) {
  Pixel at = pixelAt(projector, static_cast<std::size_t>(decoded.pixel));
  return {{0, at.x, at.y, 1.0f}};
}

/// The steps of an import and what they hand on.
class Importing {
 public:
  Importing(const PictureSequence& patterns, const PictureSequence& photographs,
            const ImportSettings& settings, std::vector<int> heldOut)
      : patterns_(patterns),
        photographs_(photographs),
        settings_(settings),
        frames_(chooseFrames(patterns, photographs, std::move(heldOut))) {
    constexpr int leastSide = 8;
    if (std::min(patterns.size().width, patterns.size().height) < leastSide)
      throw Error(
          ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("import.no-projector-size",
                                   "the patterns have {} pixels, which is too small for a projector")
              .with(as::size(patterns.size())),
          RELUCENT_ENGLISH_MESSAGE("import.give-larger-patterns", "give patterns of at least {} pixels")
              .with(as::size(leastSide, leastSide)));
    if (static_cast<int>(frames_.spatial.size()) < leastSpatial)
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("import.too-few-patterns",
                                           "{} of the patterns have content and take part in the fit, which "
                                           "is too few to tell where light comes from")
                      .with(frames_.spatial.size()),
                  RELUCENT_ENGLISH_MESSAGE(
                      "import.give-more-patterns",
                      "import at least {} different patterns, or photograph those of `relucent-cli plan`")
                      .with(leastSpatial + 2));
    response_.channels.fill(usualCurve());
    findLitPixels();
  }

  Import run(Progress& progress) {
    Progress decoding = progress.part(0.35, RELUCENT_MESSAGE("stage.decoding", "Decoding"));
    decode(decoding);
    Progress sampling = progress.part(
        0.1, RELUCENT_MESSAGE("stage.estimating-response-and-colours", "Estimating response and colours"));
    alternate(sampling);
    Progress spreading =
        progress.part(0.45, RELUCENT_MESSAGE("stage.fitting-light-spread", "Fitting the spread of light"));
    fitFootprints(litPixels_, spreading);
    Progress assembling = progress.part(
        0.07, RELUCENT_MESSAGE("stage.assembling-light-transport", "Assembling the light transport"));
    Import result = assembled(assembling);
    Progress scoring = progress.part(
        0.03, RELUCENT_MESSAGE("stage.predicting-held-out-patterns", "Predicting held-out patterns"));
    if (!frames_.heldOut.empty()) score(result, scoring);
    addFindings(result);
    progress.report(1.0);
    return result;
  }

 private:
  void findLitPixels() {
    lit_ = litPixels(photographs_, frames_);
    for (std::size_t pixel = 0; pixel < lit_.size(); ++pixel)
      if (lit_[pixel] != 0) litPixels_.push_back(static_cast<std::uint32_t>(pixel));
    if (litPixels_.empty())
      throw Error(
          ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("import.photographs-alike",
                                   "the photographs are all alike: no camera pixel reacts to the patterns"),
          RELUCENT_ENGLISH_MESSAGE(
              "import.check-patterns-and-photographs",
              "check that patterns and photographs belong together and that the projector was on"));
  }

  void decode(Progress& progress) {
    pyramid_ = sequencePyramid(patterns_, frames_, DriveTable(response_));
    Progress descending = progress.part(0.7, RELUCENT_MESSAGE("stage.decoding", "Decoding"));
    decoded_ = decodePixels({pyramid_, photographs_, frames_}, litPixels_, settings_.beam, descending);
    Progress propagating = progress.part(0.3, RELUCENT_MESSAGE("stage.decoding", "Decoding"));
    propagate({pyramid_, photographs_, frames_}, lit_, decoded_, propagating);
    agreeOnPlaces(pyramid_, photographs_.size(), decoded_);
    footprint_.resize(decoded_.size());
    residual_.resize(decoded_.size());
  }

  /// Footprints, mixing and response in turns on a sample, each better for the others.
  void alternate(Progress& progress) {
    bool levels = false;
    for (int c = 0; c < 3; ++c) levels = levels || codesOf(patterns_, frames_, c).size() > 2;
    responseKnown_ = levels;
    for (int frame : frames_.fitted) isBinary_.push_back(isBinary(patterns_, frame) ? 1 : 0);
    const int rounds = levels ? 4 : 2;
    std::vector<std::uint32_t> chosen = sample();
    for (int round = 0; round < rounds; ++round) {
      Progress fitting = progress.part(1.0 / rounds, progress.stage());
      fitFootprints(chosen, fitting);
      updatePrior(chosen);
      FrameReader reader({patterns_, photographs_, frames_}, pyramid_, DriveTable(response_));
      std::vector<PixelFrames> seen;
      std::vector<SamplePixel> sampled;
      for (std::uint32_t pixel : chosen) {
        if (!footprint_[pixel].found()) continue;
        seen.push_back(reader.read(pixel, sharesOf(footprint_[pixel], patterns_.size())));
        sampled.push_back({pixel, footprint_[pixel], {}});
      }
      if (seen.empty()) return;
      mixing_ = commonMixing(seen);
      if (!levels || round + 1 == rounds) continue;
      for (std::size_t i = 0; i < seen.size(); ++i)
        sampled[i].colour = fitColour(blackAndWhite(seen[i]), mixing_, prior_.noise, false);
      response_ = estimateResponse({patterns_, photographs_, frames_}, sampled, response_);
      pyramid_ = sequencePyramid(patterns_, frames_, DriveTable(response_));
    }
  }

  /// Only the frames without levels between black and white, where these are enough: what they say of gains
  /// is true whatever the response is, so that curves are found in one step.
  PixelFrames blackAndWhite(PixelFrames seen) const {
    constexpr float least = 8.0f;
    Eigen::VectorXf weight = seen.weight;
    for (std::size_t row = 0; row < frames_.fitted.size(); ++row)
      if (!isBinary_[row]) weight[static_cast<Eigen::Index>(row)] = 0.0f;
    if (weight.sum() >= least) seen.weight = weight;
    return seen;
  }

  /// Pixels that decoded well, evenly spread over the lit ones.
  std::vector<std::uint32_t> sample() const {
    std::vector<float> correlation;
    for (std::uint32_t pixel : litPixels_) correlation.push_back(decoded_[pixel].correlation);
    auto middle = correlation.begin() + static_cast<std::ptrdiff_t>(correlation.size() / 2);
    std::nth_element(correlation.begin(), middle, correlation.end());
    std::vector<std::uint32_t> good, chosen;
    for (std::uint32_t pixel : litPixels_)
      if (decoded_[pixel].pixel >= 0 && decoded_[pixel].correlation >= *middle) good.push_back(pixel);
    std::size_t count = std::min(sampleSize, good.size());
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(good[i * good.size() / count]);
    return chosen;
  }

  void updatePrior(const std::vector<std::uint32_t>& chosen) {
    std::array<std::vector<float>, 3> values;
    for (std::uint32_t pixel : chosen) {
      if (!footprint_[pixel].found()) continue;
      values[0].push_back(footprint_[pixel].sigmaX);
      values[1].push_back(footprint_[pixel].sigmaY);
      values[2].push_back(residual_[pixel]);
    }
    if (values[0].empty()) return;
    for (std::vector<float>& of : values)
      std::nth_element(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2), of.end());
    auto median = [&](std::size_t i) { return values[i][values[i].size() / 2]; };
    constexpr float leastNoise = 1e-4f;
    prior_ = {median(0), median(1), std::max(leastNoise, median(2))};
  }

  void fitFootprints(const std::vector<std::uint32_t>& pixels, Progress& progress) {
    FootprintFitter fitter(pyramid_, photographs_, frames_, prior_);
    parallelInParts(pixels, progress, [&](std::uint32_t pixel) {
      FootprintFitter::Fit fit = fitter.fit(pixel, decoded_[pixel]);
      footprint_[pixel] = fit.footprint;
      residual_[pixel] = fit.residual;
    });
  }

  /// Colour, black and row of every camera pixel.
  Import assembled(Progress& progress) {
    std::size_t pixels = photographs_.size().count();
    LargeVector<PixelColour> colours(pixels);
    oneToOne_.resize(pixels);
    mix_.resize(pixels);
    Import result;
    result.heldOut = frames_.heldOut;
    transport::Acquisition& acquisition = result.acquisition;
    acquisition.flagged.assign(pixels, 0);
    FrameReader reader({patterns_, photographs_, frames_}, pyramid_, DriveTable(response_));
    std::vector<std::uint32_t> all(pixels);
    std::iota(all.begin(), all.end(), 0u);
    Progress colouring = progress.part(0.6, progress.stage());
    parallelInParts(all, colouring, [&](std::uint32_t pixel) {
      if (lit_[pixel] != 0 && decoded_[pixel].pixel >= 0) {
        PixelFrames seen = reader.read(pixel, pixelAlone(decoded_[pixel], patterns_.size()));
        oneToOne_[pixel] = fitGains(seen, prior_.noise, false);
        mix_[pixel] = colourOf(seen, false);
      }
      PixelFrames seen = footprint_[pixel].found()
                             ? reader.read(pixel, sharesOf(footprint_[pixel], patterns_.size()))
                             : reader.readEverywhere(pixel);
      colours[pixel] = colourOf(seen, footprint_[pixel].found());
      // Light from everywhere cannot be compensated pixel by pixel: no inverse may rely on such a row.
      bool known = footprint_[pixel].found() && isExplained(seen, colours[pixel]);
      acquisition.flagged[pixel] = known ? 0 : 1;
    });
    progress.checkpoint();
    acquisition.transport = importedTransport(footprint_, colours, patterns_.size(), photographs_.size());
    Progress finishing = progress.part(0.4, progress.stage());
    acquisition.flood = acquisition.transport.floodlight();
    finishing.report(1.0);
    acquisition.black.resize(3 * pixels);
    for (std::size_t i = 0; i < 3 * pixels; ++i)
      acquisition.black[i] = std::max(0.0f, colours[i / 3].black[static_cast<Eigen::Index>(i % 3)]);
    // Black and flood are fitted to all frames at once; half of these lit, half of these dark.
    float variance = prior_.noise * prior_.noise * 4.0f / static_cast<float>(frames_.fitted.size());
    acquisition.blackVariance.assign(3 * pixels, variance);
    acquisition.floodVariance.assign(3 * pixels, 2.0f * variance);
    acquisition.patterns = patterns_.pictures();
    acquisition.exposures = photographs_.pictures();
    result.linearization.projectors = {response_};
    result.linearization.cameras.resize(1);
    result.linearization.cameras.front().readNoise = prior_.noise;
    result.linearization.exposures = {1.0};
    result.linearization.additivityError = {0.0};
    return result;
  }

  /// Grey patterns say nothing about mixing: then a gain for each channel is all there is.
  PixelColour colourOf(const PixelFrames& seen, bool withFar) const {
    return colouredPatterns() ? fitColour(seen, mixing_, prior_.noise, withFar)
                              : fitGains(seen, prior_.noise, withFar);
  }

  bool colouredPatterns() const {
    return std::any_of(frames_.fitted.begin(), frames_.fitted.end(),
                       [&](int frame) { return patterns_.isColoured(frame); });
  }

  void score(Import& result, Progress& progress) const {
    HeldOutScore scores = scoreHeldOut({patterns_, photographs_, frames_, lit_, decoded_, oneToOne_, mix_},
                                       result.acquisition, DriveTable(response_), progress);
    result.error = scores.error;
    result.acquisition.verificationError = scores.relative;
  }

  void addFindings(Import& result) const {
    std::vector<Message>& findings = result.acquisition.findings;
    if (!colouredPatterns())
      findings.push_back(
          photographs_.isColoured()
              ? RELUCENT_MESSAGE(
                    "import.patterns-grey",
                    "The patterns are grey: how colours mix was not measured, and T's blocks are diagonal")
              : RELUCENT_MESSAGE("import.patterns-and-photographs-grey",
                                 "Patterns and photographs are grey: colours are not told apart, and T's "
                                 "blocks are neutral"));
    else if (!photographs_.isColoured())
      findings.push_back(RELUCENT_MESSAGE("import.photographs-grey",
                                          "The photographs are grey: what each of the projector's colours "
                                          "contributes is known in brightness only"));
    if (!responseKnown_)
      result.linearization.findings.push_back(
          RELUCENT_MESSAGE("import.patterns-black-and-white",
                           "The patterns hold black and white only: the projector's response is assumed to "
                           "be a gamma of 2.2"));
    result.linearization.findings.push_back(RELUCENT_MESSAGE(
        "import.camera-taken-as-linear",
        "The camera is taken to be linear, and one photograph counts as one second of exposure"));
    double share = static_cast<double>(litPixels_.size()) / static_cast<double>(lit_.size());
    if (share < 0.9)
      findings.push_back(
          RELUCENT_MESSAGE("import.lit-share", "The projector lights {} % of the camera's pixels")
              .with(as::share(share, as::decimals(0))));
  }

  const PictureSequence& patterns_;
  const PictureSequence& photographs_;
  const ImportSettings& settings_;
  ImportFrames frames_;
  linearization::ProjectorResponse response_;
  bool responseKnown_ = false;
  std::vector<std::uint8_t> isBinary_;  // of each fitted frame: nothing between black and white
  transport::ColourBlock mixing_ = transport::ColourBlock::Identity();
  FootprintPrior prior_;
  SequencePyramid pyramid_;
  CameraMask lit_;
  std::vector<std::uint32_t> litPixels_;
  std::vector<Decoded> decoded_;
  std::vector<Footprint> footprint_;
  std::vector<float> residual_;
  LargeVector<PixelColour> oneToOne_, mix_;
};

}  // namespace

std::vector<Message> problems(const ImportSettings& settings) {
  std::vector<Message> found;
  if (settings.holdOutEvery < 2)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("import.held-out-too-often",
                                             "at most every second pattern can be held out"));
  if (settings.beam < 1)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("import.search-keeps-nothing", "the search has to keep at least one place"));
  return found;
}

Import importTransport(const PictureSequence& patterns, const PictureSequence& photographs,
                       const ImportSettings& settings, Progress& progress) {
  require(problems(settings).empty(), "settings with problems");
  require(patterns.pictures() == photographs.pictures(), "{} patterns and {} photographs",
          patterns.pictures(), photographs.pictures());
  std::vector<int> heldOut = heldOutPatterns(patterns, settings.holdOutEvery);
  Progress predicting = progress.part(settings.refit ? 0.5 : 1.0, progress.stage());
  Import predicted = Importing(patterns, photographs, settings, heldOut).run(predicting);
  if (!settings.refit) return predicted;
  const double verificationError = predicted.acquisition.verificationError;
  predicted.acquisition = {};  // there is memory for one T
  Progress refitting = progress.part(0.5, progress.stage());
  Import import = Importing(patterns, photographs, settings, {}).run(refitting);
  import.heldOut = predicted.heldOut;
  import.error = predicted.error;
  import.acquisition.verificationError = verificationError;
  return import;
}

}  // namespace relucent::importing
