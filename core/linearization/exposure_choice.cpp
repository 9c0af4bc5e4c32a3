// SPDX-License-Identifier: MIT
#include "relucent/linearization/exposure_choice.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "relucent/base/error.h"
#include "relucent/hdr/hdr.h"
#include "relucent/linearization/test_light.h"

namespace relucent::linearization {
namespace {

constexpr double wantedShare = 0.8;   // of saturation, at the 99.5th percentile of the flood image
constexpr double longerBy = 12.0;     // for what is dim
constexpr double largestStep = 16.0;  // between neighbouring exposures
constexpr double clipping = 0.98;     // share of saturation that counts as clipped
constexpr double blindStep = 16.0;    // from an exposure that is all saturated or all dark
constexpr double wideStep = 9.0;   // between neighbouring exposures: another one between tells the response
constexpr double leastStep = 1.4;  // between exposures, for clipping to be told from light
constexpr int mostPhotographs = 24;

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

/// One exposure by all cameras.
struct Photograph {
  double asked;
  const std::vector<rig::RawFrame>* frames;
  const image::Image& signal(std::size_t camera) const { return (*frames)[camera].signal; }
};

/// Of all shots, the longest exposure first.
std::vector<Photograph> photographsOf(const std::vector<rig::Shot>& shots) {
  std::vector<Photograph> photographs;
  for (const rig::Shot& shot : shots)
    for (std::size_t exposure = 0; exposure < shot.frames.size(); ++exposure)
      photographs.push_back({shot.exposuresAsked[exposure], &shot.frames[exposure]});
  std::ranges::stable_sort(photographs, std::ranges::greater(), &Photograph::asked);
  return photographs;
}

/// The signal at which a camera clips: some deliver less than full scale. It shows as many equal values at
/// the top of an exposure that a shorter one reaches as well.
double saturationOf(const std::vector<Photograph>& whites, std::size_t camera) {
  for (std::size_t exposure = 0; exposure + 1 < whites.size(); ++exposure) {
    std::vector<float> longer = brightest(whites[exposure].signal(camera));
    std::vector<float> shorter = brightest(whites[exposure + 1].signal(camera));
    float most = *std::max_element(longer.begin(), longer.end());
    auto clipped =
        std::count_if(longer.begin(), longer.end(), [&](float value) { return value > most - 0.002f; });
    bool much = whites[exposure].asked > leastStep * whites[exposure + 1].asked;
    bool reachedEarlier = *std::max_element(shorter.begin(), shorter.end()) > most - 0.002f;
    if (much && reachedEarlier && static_cast<double>(clipped) >= 0.005 * static_cast<double>(longer.size()))
      return hdr::saturationMargin * std::min(static_cast<double>(most), 1.0);
  }
  return hdr::saturationMargin;
}

/// Times that may be asked for: any of a range, or only the whole multiples of a lamp's period in it.
class Times {
 public:
  Times(rig::ExposureRange range, double unit) : range_(range), unit_(unit) {
    const double least = unit_ > 0.0 ? unit_ * std::ceil(range_.shortest / unit_ - tiny) : range_.shortest;
    if (least > range_.longest) unit_ = 0.0;  // none of them is within the range
    if (unit_ > 0.0) range_.shortest = least;
  }

  double shortest() const { return range_.shortest; }
  double longest() const { return nearest(range_.longest); }
  /// No longer than wanted, if there is any.
  double nearest(double seconds) const {
    const double within = std::clamp(seconds, range_.shortest, range_.longest);
    return unit_ > 0.0 ? unit_ * std::floor(within / unit_ + tiny) : within;
  }

 private:
  static constexpr double tiny = 1e-6;
  rig::ExposureRange range_;
  double unit_;
};

/// The search for one camera's exposure.
struct Search {
  std::string name;
  double saturation = hdr::saturationMargin;
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

  /// The exposure at which the brightest of what is lit comes to the wanted level.
  void findHighlights(const std::vector<Photograph>& whites, std::size_t camera) {
    for (const Photograph& white : whites) {
      double most = brightestLit(white.signal(camera));
      highlights = white.asked;
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
  void learn(const image::Image& signal, const Times& times) {
    level = levelOf(signal);
    highlightsClip = brightestLit(signal) > clipping * saturation;
    double wanted = wantedShare * saturation;
    bool good = level > 0.93 * wanted && level < 1.06 * wanted;
    double step = lit.empty() ? blindStep : 4.0;
    double next = level > clipping * saturation
                      ? seconds / (lit.empty() ? blindStep : 2.0)
                      : seconds * std::clamp(wanted / std::max(level, 1e-9), 1.0 / step, step);
    next = times.nearest(next);
    settled = good || next == seconds;
    if (!settled) seconds = next;
  }

  /// Whether the last photograph, well exposed or as well as can be, can tell what is lit.
  bool tellsLight() const { return settled || (level > 0.2 * saturation && level <= clipping * saturation); }
};

/// Pixels that white makes brighter than noise could: where white is darker than black, that is noise.
std::vector<std::size_t> litPixels(const image::Image& white, const image::Image& black, int bits) {
  std::vector<float> noise;
  for (std::size_t i = 0; i < black.data().size(); ++i)
    noise.push_back(std::max(0.0f, black.data()[i] - white.data()[i]));
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
std::vector<double> spread(const std::vector<Search>& searches, const Times& times) {
  std::vector<double> wanted = wantedBy(searches, false);
  double shortest = wanted.back(), longest = times.nearest(longerBy * wanted.front());
  double ratio = longest / shortest;
  if (ratio < 1.5) return {shortest};
  int steps = static_cast<int>(std::ceil(std::log(ratio) / std::log(largestStep) - 1e-9));
  std::vector<double> seconds;
  for (int i = 0; i < steps; ++i)
    seconds.push_back(times.nearest(longest * std::pow(ratio, -static_cast<double>(i) / steps)));
  seconds.push_back(shortest);
  return unique(std::move(seconds));
}

/// Shorter exposures for the highlights that clip at the shortest of `seconds`, in even steps.
void addHighlights(std::vector<double>& seconds, const std::vector<Search>& searches, const Times& times) {
  double shortest = seconds.back(), least = shortest;
  for (const Search& search : searches)
    if (search.highlightsClip) least = std::min(least, search.highlights);
  least = times.nearest(least);
  if (least >= shortest) return;
  int steps = static_cast<int>(std::ceil(std::log(shortest / least) / std::log(largestStep) - 1e-9));
  for (int i = 1; i <= steps; ++i)
    seconds.push_back(times.nearest(shortest * std::pow(least / shortest, static_cast<double>(i) / steps)));
  seconds = unique(std::move(seconds));
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

/// The search for the exposures of all cameras.
class Exposing {
 public:
  Exposing(rig::ShotTaker& shots, Progress& progress, double unit)
      : shots_(shots), progress_(progress), times_(commonRange(shots.rig()), unit) {
    for (const auto& camera : shots.rig().cameras) {
      Search search;
      search.name = camera->name();
      search.seconds = times_.nearest(std::sqrt(times_.shortest() * times_.longest()));
      searches_.push_back(std::move(search));
    }
  }

  ExposureChoice run() {
    while (!std::ranges::all_of(searches_, &Search::tellsLight) && mayGoOn()) photographWhite();
    photographBlack();
    while (!std::ranges::all_of(searches_, &Search::settled) && mayGoOn()) photographWhite();
    findHighlights();

    ExposureChoice choice;
    choice.seconds = spread(searches_, times_);
    addHighlights(choice.seconds, searches_, times_);
    choice.findings = remarks(searches_);
    photographRest(choice.seconds);
    for (const Search& search : searches_) choice.saturation.push_back(search.saturation);
    chooseForLight(choice);
    choice.whites = std::move(whites_);
    choice.black = std::move(black_);
    return choice;
  }

 private:
  bool mayGoOn() const { return whites_.size() < mostPhotographs; }

  void take(const std::vector<double>& seconds) {
    whites_.push_back(shots_.take(evenPatterns(shots_.rig(), {1, 1, 1}), seconds, progress_));
    progress_.report(std::min(0.9, 0.1 * static_cast<double>(whites_.size())));
  }

  /// At the exposures of the cameras that are still searching.
  void photographWhite() {
    std::vector<double> seconds = wantedBy(searches_, true);
    take(seconds);
    const std::vector<Photograph> all = photographsOf(whites_);
    for (std::size_t camera = 0; camera < searches_.size(); ++camera) {
      Search& search = searches_[camera];
      search.saturation = saturationOf(all, camera);
      if (!search.settled)
        search.learn(whites_.back().frames[indexIn(seconds, search.seconds)][camera].signal, times_);
    }
  }

  /// At the exposures of the last photographs of white that tell what is lit.
  void photographBlack() {
    const std::vector<Photograph> all = photographsOf(whites_);
    std::vector<std::size_t> exposures;
    std::vector<double> seconds;
    for (std::size_t camera = 0; camera < searches_.size(); ++camera) {
      const Search& search = searches_[camera];
      std::size_t exposure = 0;
      while (exposure + 1 < all.size() &&
             search.levelOf(all[exposure].signal(camera)) > clipping * search.saturation)
        ++exposure;
      exposures.push_back(exposure);
      seconds.push_back(all[exposure].asked);
    }
    const std::vector<double> asked = unique(seconds);
    black_ = shots_.take(evenPatterns(shots_.rig(), {0, 0, 0}), asked, progress_);
    for (std::size_t camera = 0; camera < searches_.size(); ++camera) {
      Search& search = searches_[camera];
      const rig::RawFrame& lit = (*all[exposures[camera]].frames)[camera];
      search.lit =
          litPixels(lit.signal, black_.frames[indexIn(asked, seconds[camera])][camera].signal, lit.bits);
      if (static_cast<double>(search.lit.size()) <
          std::max(8.0, 0.002 * static_cast<double>(lit.signal.pixels())))
        throw Error(
            ErrorKind::input,
            RELUCENT_ENGLISH_MESSAGE("linearization.no-contrast",
                                     "the camera sees no difference between a white and a black projection"),
            RELUCENT_ENGLISH_MESSAGE(
                "linearization.check-projector-cap-and-aim",
                "check that the projector is on and shows the pictures, that the lens cap "
                "is off, and that the camera looks at the projection"),
            search.name);
      // The percentile of what is lit is not that of the whole view.
      search.settled = false;
      search.seconds = seconds[camera];
      search.learn(lit.signal, times_);
    }
  }

  /// Ever shorter, until nothing clips.
  void findHighlights() {
    auto clips = [&] {
      const std::vector<Photograph> all = photographsOf(whites_);
      bool any = false;
      for (std::size_t camera = 0; camera < searches_.size(); ++camera) {
        searches_[camera].findHighlights(all, camera);
        any = any || (searches_[camera].highlightsClip && searches_[camera].clips);
      }
      return any;
    };
    while (clips() && mayGoOn()) {
      double shortest = photographsOf(whites_).back().asked;
      if (shortest <= times_.shortest()) return;
      take({times_.nearest(shortest / 4.0)});
    }
  }

  /// White at the exposures that were chosen, and between those that are far apart: three or more tell a
  /// camera's response.
  void photographRest(const std::vector<double>& seconds) {
    std::vector<double> open;
    std::vector<double> all;
    for (const Photograph& photograph : photographsOf(whites_)) all.push_back(photograph.asked);
    for (double wanted : seconds)
      if (std::ranges::count(all, wanted) == 0) open.push_back(wanted);
    all.insert(all.end(), open.begin(), open.end());
    std::erase_if(all, [&](double asked) { return asked > seconds.front() || asked < seconds.back(); });
    all = unique(std::move(all));
    const auto alsoTake = [&](double wanted) {
      if (std::ranges::count(all, times_.nearest(wanted)) == 0) open.push_back(times_.nearest(wanted));
    };
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      if (all[i] > wideStep * all[i + 1]) alsoTake(all[i] / std::sqrt(1.3 * all[i] / all[i + 1]));
    if (seconds.size() == 1)
      for (double shorter : {1.5, 3.0})
        if (seconds[0] / shorter >= times_.shortest()) alsoTake(seconds[0] / shorter);
    if (!open.empty()) take(unique(std::move(open)));
  }

  /// For every camera the longest of the exposures that does not overexpose.
  void chooseForLight(ExposureChoice& choice) const {
    choice.dimmerBy = 1.0;
    for (const Search& search : searches_) {
      auto longest = [&](double seconds) {
        for (double exposure : choice.seconds)
          if (exposure <= 1.01 * seconds) return exposure;
        return choice.seconds.back();
      };
      choice.flood.push_back(longest(search.seconds));
      choice.dim.push_back(longest(longerBy * search.seconds));
      choice.dimmerBy = std::max(choice.dimmerBy, choice.dim.back() / choice.flood.back());
    }
    choice.flood = unique(std::move(choice.flood));
    choice.dim = unique(std::move(choice.dim));
  }

  rig::ShotTaker& shots_;
  Progress& progress_;
  Times times_;
  std::vector<Search> searches_;
  std::vector<rig::Shot> whites_;
  rig::Shot black_;
};

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

ExposureChoice chooseExposures(rig::ShotTaker& shots, Progress& progress, double unit) {
  return Exposing(shots, progress, unit).run();
}

std::optional<rig::Shot> atExposures(const std::vector<rig::Shot>& shots, std::vector<double> seconds) {
  if (shots.empty()) return std::nullopt;
  const std::vector<Photograph> all = photographsOf(shots);
  rig::Shot result{shots.back().id, shots.back().fingerprint, {}, {}};
  for (double wanted : unique(std::move(seconds))) {
    auto found = std::ranges::find(all, wanted, &Photograph::asked);
    if (found == all.end()) return std::nullopt;
    result.frames.push_back(*found->frames);
    result.exposuresAsked.push_back(wanted);
  }
  return result;
}

}  // namespace relucent::linearization
