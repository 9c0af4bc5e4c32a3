// SPDX-License-Identifier: MIT
#include "relucent/acquisition/refinement.h"

#include <limits>
#include <memory>

#include "relucent/acquisition/colour_class.h"
#include "relucent/acquisition/lookahead.h"
#include "relucent/base/error.h"

namespace relucent::acquisition {
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
  Division(Tree& tree, const LevelPlan& plan, const TreeContext& context, Progress& progress)
      : tree_(tree),
        plan_(plan),
        context_(context),
        progress_(progress),
        pairs_(tree.active, plan.schedule),
        children_(tree.active.blocks(), plan.level > 1, context.scheme.restToParent),
        frames_(framesInOrder()),
        lookahead_(frames_.size(), [this](std::size_t number, const PreparedFrame* before) {
          return prepare(number, before);
        }) {}

  std::optional<sentinels::Interruption> run() {
    std::size_t first = 0;
    while (first < frames_.size()) {
      std::size_t end = first;
      while (end < frames_.size() && frames_[end].colour == frames_[first].colour) ++end;
      if (auto interrupted = measureColour(first, end)) return interrupted;
      lookahead_.leave([this, blocks = blocks_] { blocks->settle(children_); });
      first = end;
    }
    lookahead_.finish();
    adopt(tree_, children_, context_.references());
    return std::nullopt;
  }

 private:
  std::vector<LevelFrame> framesInOrder() const {
    std::vector<LevelFrame> frames;
    std::vector<std::uint8_t> lit = litQuadrants(plan_.schedule, tree_.layout, plan_.level);
    for (std::uint32_t colour = 0; colour < plan_.schedule.colours; ++colour)
      for (int quadrant = 0; quadrant < quadrants; ++quadrant)
        for (std::size_t light = 0; light < context_.scheme.lights.size(); ++light)
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
        sameColour ? before->blocks : std::make_shared<ColourClass>(tree_, pairs_.of(place.colour), context_);
    std::shared_ptr<const LitQuadrant> quadrant;
    if (sameColour && before->place.quadrant == place.quadrant)
      quadrant = before->frame.quadrant;
    else
      quadrant = prepared.blocks->lit(place.quadrant,
                                      litPixels(plan_.schedule, tree_.layout, place.colour, place.quadrant));
    prepared.frame = prepared.blocks->frame(std::move(quadrant), context_.scheme.lights[place.light]);
    return prepared;
  }

  /// The frames [first, end) of one colour, and all of them again where they contradict what was seen before.
  std::optional<sentinels::Interruption> measureColour(std::size_t first, std::size_t end) {
    constexpr int mostRounds = 3;
    int begun = context_.watch.shots();
    for (int round = 0; round == 0 || (round < mostRounds && blocks_->contradictsParents()); ++round) {
      if (round > 0) context_.watch.contradicted(begun, static_cast<int>(end - first));
      for (std::size_t frame = first; frame < end; ++frame) {
        if (auto interrupted = take(frame)) return interrupted;
        if (round > 0) continue;
        progress_.report(static_cast<double>(frame + 1) / static_cast<double>(frames_.size()));
        context_.observer.grew(plan_.patterns, static_cast<int>(frame) + 1);
      }
      lookahead_.finish();
    }
    return std::nullopt;
  }

  std::optional<sentinels::Interruption> take(std::size_t number) {
    return lookahead_.take(
        number,
        [&](const PreparedFrame& prepared, const photography::Meanwhile& meanwhile) {
          blocks_ = prepared.blocks;
          return blocks_->photograph(prepared.frame, progress_, meanwhile);
        },
        [](const PreparedFrame& prepared, const hdr::LampLight& seen) {
          prepared.blocks->extract(prepared.frame, seen);
        });
  }

  Tree& tree_;
  const LevelPlan& plan_;
  const TreeContext& context_;
  Progress& progress_;
  PairsByColour pairs_;
  Children children_;
  std::vector<LevelFrame> frames_;
  std::shared_ptr<ColourClass> blocks_;  // of the last frame
  Lookahead<PreparedFrame> lookahead_;
};

}  // namespace

int patternsOf(const Schedule& schedule, const Scheme& scheme, const transport::NodeLayout& layout,
               int level) {
  return static_cast<int>(scheme.lights.size()) * framesOf(schedule, layout, level);
}

std::optional<sentinels::Interruption> divide(Tree& tree, const LevelPlan& plan, const TreeContext& context,
                                              Progress& progress) {
  require(tree.active.blocks() <= std::numeric_limits<std::uint32_t>::max(), "{} active pairs",
          tree.active.blocks());
  return Division(tree, plan, context, progress).run();
}

}  // namespace relucent::acquisition
