// SPDX-License-Identifier: MIT
#include "relucent/linearization/exposure_choice.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/linearization/test_light.h"

namespace relucent::linearization {
namespace {

constexpr double wantedShare = 0.8;   // of saturation, at the 99.5th percentile of the flood image
constexpr double longerBy = 12.0;     // for what is dim
constexpr double largestStep = 16.0;  // between neighbouring exposures
constexpr double saturationMargin = 0.97;
constexpr double clipping = 0.98;  // share of saturation that counts as clipped
constexpr int mostRefinements = 8;

/// The brightest channel of every pixel.
std::vector<float> brightest(const image::Image& signal) {
  std::vector<float> values(signal.pixels());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = *std::max_element(signal.pixel(i).begin(), signal.pixel(i).end());
  return values;
}

double quantile(std::vector<float> values, double share) {
  auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return static_cast<double>(*place);
}

/// The whole range in steps of at most 4, longest first; at most 12.
std::vector<double> sweep(const rig::ExposureRange& range) {
  double ratio = range.longest / range.shortest;
  int steps = std::clamp(static_cast<int>(std::ceil(std::log(ratio) / std::log(4.0) - 1e-9)), 0, 11);
  std::vector<double> seconds;
  for (int i = 0; i <= steps; ++i)
    seconds.push_back(range.longest * std::pow(ratio, -static_cast<double>(i) / std::max(1, steps)));
  return seconds;
}

/// The signal at which a camera clips: some deliver less than full scale. It shows as many equal values at
/// the top of an exposure that a much shorter one reaches as well.
double saturationOf(const rig::Shot& white, std::size_t camera) {
  double top = 1.0;
  if (white.frames.size() > 1) {
    std::vector<float> longest = brightest(white.frames[0][camera].signal);
    std::vector<float> shorter = brightest(white.frames[1][camera].signal);
    float most = *std::max_element(longest.begin(), longest.end());
    auto clipped =
        std::count_if(longest.begin(), longest.end(), [&](float value) { return value > most - 0.002f; });
    bool reachedEarlier = *std::max_element(shorter.begin(), shorter.end()) > most - 0.002f;
    if (reachedEarlier && static_cast<double>(clipped) >= 0.005 * static_cast<double>(longest.size()))
      top = static_cast<double>(most);
  }
  return saturationMargin * std::min(top, 1.0);
}

/// The search for one camera's exposure.
struct Search {
  std::string name;
  double saturation = saturationMargin;
  double seconds = 0.0;
  double level = 0.0;  // 99.5th percentile at `seconds`
  std::vector<std::size_t> lit;
  bool highlightsClip = false;  // something lit clips at `seconds`, ...
  double highlights = 0.0;      // nothing does at this exposure, ...
  bool clips = false;           // unless something does at every one
  bool settled = false;

  double levelOf(const image::Image& signal) const {
    std::vector<float> all = brightest(signal), values;
    for (std::size_t at : lit) values.push_back(all[at]);
    return quantile(lit.empty() ? all : values, 0.995);
  }

  /// From the sweep: the exposure at which the brightest of what is lit comes to the wanted level.
  void findHighlights(const rig::Shot& white, std::size_t camera, const std::vector<double>& sweepSeconds) {
    for (std::size_t exposure = 0; exposure < sweepSeconds.size(); ++exposure) {
      double most = brightestLit(white.frames[exposure][camera].signal);
      highlights = sweepSeconds[exposure];
      clips = most > clipping * saturation;
      if (clips) continue;
      highlights *= std::clamp(wantedShare * saturation / most, 0.25, 4.0);
      return;
    }
  }

  double brightestLit(const image::Image& signal) const {
    std::vector<float> values = brightest(signal);
    float most = 0.0f;
    for (std::size_t at : lit) most = std::max(most, values[at]);
    return static_cast<double>(most);
  }

  /// Takes in a photograph at `seconds` and moves on towards the wanted level.
  void learn(const image::Image& signal, const rig::ExposureRange& range) {
    level = levelOf(signal);
    highlightsClip = brightestLit(signal) > clipping * saturation;
    double wanted = wantedShare * saturation;
    bool good = level > 0.93 * wanted && level < 1.06 * wanted;
    double next =
        level > clipping * saturation ? 0.5 * seconds : seconds * std::clamp(wanted / level, 0.25, 4.0);
    next = std::clamp(next, range.shortest, range.longest);
    settled = good || next == seconds;
    if (!settled) seconds = next;
  }
};

/// Pixels that white makes brighter than two photographs of black differ from each other.
std::vector<std::size_t> litPixels(const image::Image& white, const image::Image& black,
                                   const image::Image& blackAgain, int bits) {
  std::vector<float> noise;
  for (std::size_t i = 0; i < black.data().size(); ++i)
    noise.push_back(std::abs(black.data()[i] - blackAgain.data()[i]));
  double step = bits > 0 ? 1.0 / (std::ldexp(1.0, bits) - 1.0) : 1e-6;
  double floor = 2.0 * std::max(quantile(noise, 0.999), step);
  std::vector<std::size_t> lit;
  for (std::size_t i = 0; i < white.pixels(); ++i) {
    double rise = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
      rise = std::max(rise, static_cast<double>(white.pixel(i)[c] - black.pixel(i)[c]));
    if (rise > floor) lit.push_back(i);
  }
  return lit;
}

std::vector<double> unique(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end(), std::greater<>());
  seconds.erase(std::unique(seconds.begin(), seconds.end()), seconds.end());
  return seconds;
}

std::size_t indexIn(const std::vector<double>& seconds, double value) {
  return static_cast<std::size_t>(std::find(seconds.begin(), seconds.end(), value) - seconds.begin());
}

std::vector<double> wantedBy(const std::vector<Search>& searches, bool unsettledOnly) {
  std::vector<double> seconds;
  for (const Search& search : searches)
    if (!unsettledOnly || !search.settled) seconds.push_back(search.seconds);
  return unique(std::move(seconds));
}

/// From the shortest that a camera needs to the longest, in even steps.
std::vector<double> spread(const std::vector<Search>& searches, const rig::ExposureRange& range) {
  std::vector<double> wanted = wantedBy(searches, false);
  double shortest = wanted.back(), longest = std::min(longerBy * wanted.front(), range.longest);
  double ratio = longest / shortest;
  if (ratio < 1.5) return {shortest};
  int steps = static_cast<int>(std::ceil(std::log(ratio) / std::log(largestStep) - 1e-9));
  std::vector<double> seconds;
  for (int i = 0; i < steps; ++i)
    seconds.push_back(longest * std::pow(ratio, -static_cast<double>(i) / steps));
  seconds.push_back(shortest);
  return seconds;
}

/// Shorter exposures for the highlights that clip at the shortest of `seconds`, in even steps.
void addHighlights(std::vector<double>& seconds, const std::vector<Search>& searches,
                   const rig::ExposureRange& range) {
  double shortest = seconds.back(), least = shortest;
  for (const Search& search : searches)
    if (search.highlightsClip) least = std::min(least, search.highlights);
  least = std::max(least, range.shortest);
  if (least >= shortest) return;
  int steps = static_cast<int>(std::ceil(std::log(shortest / least) / std::log(largestStep) - 1e-9));
  for (int i = 1; i <= steps; ++i)
    seconds.push_back(shortest * std::pow(least / shortest, static_cast<double>(i) / steps));
}

/// What a sweep over the whole range tells about every camera: where it clips, and the longest exposure at
/// which it does not.
std::vector<Search> startSearches(const rig::Rig& rig, const rig::Shot& white,
                                  const std::vector<double>& seconds) {
  std::vector<Search> searches;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    Search search;
    search.name = rig.cameras[camera]->name();
    search.saturation = saturationOf(white, camera);
    std::size_t exposure = 0;
    while (exposure + 1 < seconds.size() &&
           search.levelOf(white.frames[exposure][camera].signal) > 0.9 * search.saturation)
      ++exposure;
    search.seconds = seconds[exposure];
    searches.push_back(std::move(search));
  }
  return searches;
}

void findLight(std::vector<Search>& searches, const rig::Shot& white, const std::vector<double>& sweepSeconds,
               const rig::Shot& black, const rig::Shot& blackAgain, const std::vector<double>& blackSeconds) {
  for (std::size_t camera = 0; camera < searches.size(); ++camera) {
    Search& search = searches[camera];
    const rig::RawFrame& lit = white.frames[indexIn(sweepSeconds, search.seconds)][camera];
    std::size_t exposure = indexIn(blackSeconds, search.seconds);
    search.lit = litPixels(lit.signal, black.frames[exposure][camera].signal,
                           blackAgain.frames[exposure][camera].signal, lit.bits);
    if (static_cast<double>(search.lit.size()) <
        std::max(8.0, 0.002 * static_cast<double>(lit.signal.pixels())))
      throw Error(
          ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("linearization.no-contrast",
                                   "the camera sees no difference between a white and a black projection"),
          RELUCENT_ENGLISH_MESSAGE("linearization.check-projector-cap-and-aim",
                                   "check that the projector is on and shows the pictures, that the lens cap "
                                   "is off, and that the camera looks at the projection"),
          search.name);
    search.findHighlights(white, camera, sweepSeconds);
  }
}

std::vector<Message> remarks(const std::vector<Search>& searches) {
  std::vector<Message> findings;
  for (const Search& search : searches) {
    if (search.level > clipping * search.saturation)
      findings.push_back(RELUCENT_MESSAGE("linearization.overexposed",
                                          "{}: the projection is overexposed even at {} s, the shortest "
                                          "exposure; close the aperture, lower the gain or add a grey filter")
                             .with(search.name, as::seconds(search.seconds, as::digits(3))));
    else if (search.level < 0.25 * search.saturation)
      findings.push_back(RELUCENT_MESSAGE("linearization.underexposed",
                                          "{}: the projection reaches only {} % of the camera's range at {} "
                                          "s, the longest exposure; open the aperture or raise the gain")
                             .with(search.name, as::share(search.level / search.saturation, as::decimals(0)),
                                   as::seconds(search.seconds, as::digits(3))));
    else if (search.highlightsClip && search.clips)
      findings.push_back(
          RELUCENT_MESSAGE("linearization.highlights-overexposed",
                           "{}: some highlights are overexposed even at {} s, the shortest exposure, and "
                           "will not be compensated; close the aperture or add a grey filter if they matter")
              .with(search.name, as::seconds(search.highlights, as::digits(3))));
  }
  return findings;
}

}  // namespace

rig::ExposureRange commonRange(const rig::Rig& rig) {
  rig::ExposureRange range = rig.cameras.front()->exposures();
  for (const auto& camera : rig.cameras) {
    range.shortest = std::max(range.shortest, camera->exposures().shortest);
    range.longest = std::min(range.longest, camera->exposures().longest);
  }
  if (!(range.shortest > 0.0 && range.shortest <= range.longest))
    throw Error(
        ErrorKind::device,
        RELUCENT_MESSAGE("linearization.no-common-exposure", "the cameras have no exposure time in common"),
        RELUCENT_MESSAGE("linearization.choose-overlapping-exposures",
                         "set them to ranges of exposure times that overlap"));
  return range;
}

ExposureChoice chooseExposures(rig::ShotTaker& shots, Progress& progress) {
  const rig::Rig& rig = shots.rig();
  rig::ExposureRange range = commonRange(rig);
  std::vector<double> seconds = sweep(range);
  rig::Shot white = shots.take(evenPatterns(rig, {1, 1, 1}), seconds, progress);
  progress.report(0.4);

  std::vector<Search> searches = startSearches(rig, white, seconds);
  std::vector<double> dark = wantedBy(searches, false);
  rig::Shot black = shots.take(evenPatterns(rig, {0, 0, 0}), dark, progress);
  progress.report(0.5);
  rig::Shot blackAgain = shots.take(evenPatterns(rig, {0, 0, 0}), dark, progress);
  progress.report(0.6);
  findLight(searches, white, seconds, black, blackAgain, dark);
  for (std::size_t camera = 0; camera < searches.size(); ++camera)
    searches[camera].learn(white.frames[indexIn(seconds, searches[camera].seconds)][camera].signal, range);

  for (int round = 0; round < mostRefinements; ++round) {
    std::vector<double> open = wantedBy(searches, true);
    if (open.empty()) break;
    rig::Shot closer = shots.take(evenPatterns(rig, {1, 1, 1}), open, progress);
    for (std::size_t camera = 0; camera < searches.size(); ++camera)
      if (!searches[camera].settled)
        searches[camera].learn(closer.frames[indexIn(open, searches[camera].seconds)][camera].signal, range);
    progress.report(0.6 + 0.4 * (round + 1) / mostRefinements);
  }

  ExposureChoice choice{spread(searches, range), {}, remarks(searches)};
  addHighlights(choice.seconds, searches, range);
  for (const Search& search : searches) choice.saturation.push_back(search.saturation);
  return choice;
}

}  // namespace relucent::linearization
