// SPDX-License-Identifier: MIT
#include "acquisition/refinement.h"

#include <limits>
#include <memory>

#include "acquisition/colour_class.h"
#include "acquisition/lookahead.h"
#include "base/error.h"

namespace relucent {
namespace {

/// A photograph of one colour of the schedule, in one quadrant and one light.
struct LevelFrame {
  std::uint32_t colour = 0;
  int quadrant = 0;
  std::size_t light = 0;
};

/// The same with all that can be computed before it is taken.
struct PreparedFrame {
  LevelFrame place;
  std::shared_ptr<ColourClass> blocks;
  ClassFrame frame;
};

/// One level under way.
class Division {
 public:
  Division(Tree& tree, int level, const Schedule& schedule, Watch& watch, const References& references,
           const Scheme& scheme, Progress& progress, const PatternsThrough& through)
      : tree_(tree),
        schedule_(schedule),
        watch_(watch),
        references_(references),
        scheme_(scheme),
        progress_(progress),
        through_(through),
        pairs_(tree.active, schedule),
        children_(tree.active.blocks(), level > 1, scheme.restToParent),
        frames_(framesInOrder(level)),
        lookahead_(frames_.size(), [this](std::size_t number, const PreparedFrame* before) {
          return prepare(number, before);
        }) {}

  void run() {
    std::size_t first = 0;
    while (first < frames_.size()) {
      std::size_t end = first;
      while (end < frames_.size() && frames_[end].colour == frames_[first].colour) ++end;
      std::shared_ptr<ColourClass> blocks;
      int begun = watch_.shots();
      for (int round = 0; round == 0 || (round < 3 && blocks->contradictsParents()); ++round) {
        if (round > 0) watch_.contradicted(begun, static_cast<int>(end - first));
        for (std::size_t frame = first; frame < end; ++frame) {
          blocks = take(frame);
          if (round > 0) continue;
          progress_.report(static_cast<double>(frame + 1) / static_cast<double>(frames_.size()));
          if (through_) through_(static_cast<int>(frame) + 1);
        }
        lookahead_.finish();
      }
      lookahead_.leave([this, blocks] { blocks->settle(children_); });
      first = end;
    }
    lookahead_.finish();
    adopt(tree_, children_, references_);
  }

 private:
  std::vector<LevelFrame> framesInOrder(int level) const {
    std::vector<LevelFrame> frames;
    std::vector<std::uint8_t> lit = litQuadrants(schedule_, tree_.layout, level);
    for (std::uint32_t colour = 0; colour < schedule_.colours; ++colour)
      for (int quadrant = 0; quadrant < quadrants; ++quadrant)
        for (std::size_t light = 0; light < scheme_.lights.size(); ++light)
          if (lit[quadrants * colour + static_cast<std::size_t>(quadrant)] != 0)
            frames.push_back({colour, quadrant, light});
    return frames;
  }

  PreparedFrame prepare(std::size_t number, const PreparedFrame* before) const {
    const LevelFrame& place = frames_[number];
    bool sameColour = before != nullptr && before->place.colour == place.colour;
    PreparedFrame prepared;
    prepared.place = place;
    prepared.blocks =
        sameColour ? before->blocks
                   : std::make_shared<ColourClass>(tree_, pairs_.of(place.colour), references_, scheme_);
    std::shared_ptr<const LitQuadrant> quadrant;
    if (sameColour && before->place.quadrant == place.quadrant)
      quadrant = before->frame.quadrant;
    else
      quadrant = prepared.blocks->lit(place.quadrant,
                                      litPixels(schedule_, tree_.layout, place.colour, place.quadrant));
    prepared.frame = prepared.blocks->frame(std::move(quadrant), scheme_.lights[place.light]);
    return prepared;
  }

  std::shared_ptr<ColourClass> take(std::size_t number) {
    std::shared_ptr<ColourClass> blocks;
    lookahead_.take(
        number,
        [&](const PreparedFrame& prepared, const Meanwhile& meanwhile) {
          blocks = prepared.blocks;
          return ColourClass::photograph(prepared.frame, watch_, progress_, meanwhile);
        },
        [](const PreparedFrame& prepared, const HdrFrame& seen) {
          prepared.blocks->extract(prepared.frame, seen);
        });
    return blocks;
  }

  Tree& tree_;
  const Schedule& schedule_;
  Watch& watch_;
  const References& references_;
  const Scheme& scheme_;
  Progress& progress_;
  const PatternsThrough& through_;
  PairsByColour pairs_;
  Children children_;
  std::vector<LevelFrame> frames_;
  Lookahead<PreparedFrame> lookahead_;
};

}  // namespace

int patternsOf(const Schedule& schedule, const Scheme& scheme, const NodeLayout& layout, int level) {
  return static_cast<int>(scheme.lights.size()) * framesOf(schedule, layout, level);
}

void divide(Tree& tree, int level, const Schedule& schedule, Watch& watch, const References& references,
            const Scheme& scheme, Progress& progress, const PatternsThrough& through) {
  require(tree.active.blocks() <= std::numeric_limits<std::uint32_t>::max(), "{} active pairs",
          tree.active.blocks());
  Division(tree, level, schedule, watch, references, scheme, progress, through).run();
}

}  // namespace relucent
