// SPDX-License-Identifier: MIT
// The simulated venues that are offered, what each takes, and what happens in them for practice.
#include <QRandomGenerator>
#include <algorithm>
#include <utility>

#include "relucent/base/message.h"
#include "relucent/base/time_left.h"
#include "text/message_text.h"
#include "views/number_text.h"
#include "wizard/venue/venue_page.h"

namespace relucent::gui {

std::vector<RehearsalVenue> VenuePage::rehearsalVenues() {
  return {
      {"corner", QT_TR_NOOP("Glossy corner"), QT_TR_NOOP("Light bounces between two cards"),
       ":/venues/corner.png", Difficulty::usual},
      {"statue", QT_TR_NOOP("Bust before a brick wall"),
       QT_TR_NOOP("Texture, shadow and light between surfaces"), ":/venues/statue.png", Difficulty::usual},
      {"depth", QT_TR_NOOP("Many depths"), QT_TR_NOOP("Some surfaces are out of focus"), ":/venues/depth.png",
       Difficulty::usual},
      {"dome", QT_TR_NOOP("Dome"), QT_TR_NOOP("Every part lights every other part"), ":/venues/dome.png",
       Difficulty::hard},
      {"glass", QT_TR_NOOP("Wine glass"), QT_TR_NOOP("Light is refracted both ways"), ":/venues/glass.png",
       Difficulty::hard},
      {"relief", QT_TR_NOOP("Relief, two projectors"), QT_TR_NOOP("Each shines into the other's shadows"),
       ":/venues/relief.png", Difficulty::hard},
      {"dome4", QT_TR_NOOP("Dome, four projectors"), QT_TR_NOOP("They overlap; two cameras watch"),
       ":/venues/dome4.png", Difficulty::hard},
      {"statue3", QT_TR_NOOP("Bust from three sides"),
       QT_TR_NOOP("Two projectors, three cameras: for an audience that walks"), ":/venues/statue3.png",
       Difficulty::hard},
      {"plain", QT_TR_NOOP("Painted wall"), QT_TR_NOOP("Flat, with diamonds; the easiest"),
       ":/venues/plain.png", Difficulty::easy}};
}

QString VenuePage::effortOf(const RehearsalVenue& venue) const {
  const QString time = text(expectedDuration(expectedOf(venue).seconds));
  switch (venue.difficulty) {
    case Difficulty::easy:
      return tr("Easy. Measuring takes %1").arg(time);
    case Difficulty::usual:
      return tr("Medium. Measuring takes %1").arg(time);
    case Difficulty::hard:
      return tr("Hard. Measuring takes %1").arg(time);
  }
  return {};
}

void VenuePage::chooseVenue(std::size_t index) {
  venue_ = index;
  suggestName();
  tellSettings();
}

void VenuePage::chooseSize(std::size_t index) {
  size_ = index;
  tellSettings();
}

QString VenuePage::nameOf(const RehearsalSize& size) {
  return tr(size.text).arg(sizeText(size.projector.width, size.projector.height));
}

void VenuePage::setSizes(std::vector<RehearsalSize> sizes) {
  sizes_ = std::move(sizes);
  size_ = 0;
  tellSettings();
}

bool VenuePage::hasSurprise(venue::Surprise surprise) const {
  return std::ranges::find(surprises_, surprise) != surprises_.end();
}

void VenuePage::setSurprise(venue::Surprise surprise, bool wanted) {
  if (hasSurprise(surprise) == wanted) return;
  if (wanted)
    surprises_.push_back(surprise);
  else
    std::erase(surprises_, surprise);
  tellSettings();
}

venue::SurpriseSettings VenuePage::surprisesWanted() const {
  venue::SurpriseSettings settings;
  if (mode_ != Mode::rehearse) return settings;
  constexpr double bumpShare = 0.03;  // of the camera's view: seen at once, and recognised
  settings.kinds = surprises_;
  settings.seed = surpriseSeed_.value_or(QRandomGenerator::global()->generate64());
  settings.patterns = static_cast<int>(expected().shots);
  settings.shift = std::max(settings.shift, bumpShare * sizes_[size_].camera.width);
  return settings;
}

}  // namespace relucent::gui
