// SPDX-License-Identifier: MIT
#include "wizard/preview/light_part.h"

#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/tick.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"
#include "wizard/preview/preview_page.h"

namespace relucent::gui {
namespace {

template <typename Value>
struct Way {
  Value value;
  QString name, sentence;
};

/// One of a few ways, the sentence of the chosen one below.
template <typename Value>
class WayChoice {
 public:
  using Ways = std::array<Way<Value>, 3>;  // in the order of the buttons

  WayChoice(const Ways& ways, const char* objectName, const QString& accessibleName, QVBoxLayout* column)
      : ways_(ways), choice_(new Segmented({ways[0].name, ways[1].name, ways[2].name})) {
    choice_->setObjectName(objectName);
    choice_->setAccessibleName(accessibleName);
    column->addWidget(choice_);
    sentence_ = labelOf({}, "note");
    sentence_->setObjectName(QString(objectName) + "-sentence");
    column->addWidget(sentence_);
  }
  template <typename Take>
  void onChosen(const Take& take) {
    QObject::connect(choice_, &Segmented::chosen, choice_,
                     [ways = ways_, take](int index) { take(ways[static_cast<std::size_t>(index)].value); });
  }
  void show(Value value) const {
    const auto chosen = std::ranges::find(ways_, value, &Way<Value>::value);
    choice_->setCurrent(static_cast<int>(chosen - ways_.begin()));
    choice_->setAccessibleDescription(chosen->sentence);
    sentence_->setText(chosen->sentence);
  }

 private:
  Ways ways_;
  Segmented* choice_;
  QLabel* sentence_;
};

WayChoice<compensation::Brightness>::Ways whites() {
  using compensation::Brightness;
  return {{{Brightness::even, PreviewPage::tr("Even"),
            PreviewPage::tr("One white for all pictures, as bright as most of the surface can show it.")},
           {Brightness::picture, PreviewPage::tr("By picture"),
            PreviewPage::tr("Each picture has the white at which the least of it is lost: dark ones become "
                            "brighter, bright ones dimmer.")},
           {Brightness::region, PreviewPage::tr("By region"),
            PreviewPage::tr("The same for each part of the picture, smoothly from one to the next: the least "
                            "is lost of all.")}}};
}

WayChoice<compensation::Clipping>::Ways clippings() {
  using compensation::Clipping;
  return {{{Clipping::channels, PreviewPage::tr("Bright"),
            PreviewPage::tr("Colours that the surface cannot show are as bright as can be: white on a yellow "
                            "wall turns yellow.")},
           {Clipping::half, PreviewPage::tr("Between"),
            PreviewPage::tr("Colours that the surface cannot show become somewhat dimmer and shift less.")},
           {Clipping::hue, PreviewPage::tr("True"),
            PreviewPage::tr("Colours that the surface cannot show are dimmed until their hue is right: for "
                            "faces and logos.")}}};
}

}  // namespace

QWidget* lightPart(PreviewPage& page) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(PreviewPage::tr("Light"), "section"));
  WayChoice<compensation::Brightness> white(whites(), "white", PreviewPage::tr("How bright white is"),
                                            column);
  auto* bright = new ValueRow(PreviewPage::tr("May stay too dark"));
  auto* brightness = new QSlider(Qt::Horizontal);
  brightness->setRange(0, 60);
  brightness->setObjectName("brightness");
  brightness->setAccessibleName(PreviewPage::tr("Share of the content that may stay too dark, percent"));
  column->addWidget(bright);
  column->addWidget(brightness);
  column->addWidget(labelOf(
      PreviewPage::tr("The larger this share, the brighter the picture, and the more of it stays too dark."),
      "note"));
  column->addWidget(labelOf(PreviewPage::tr("Colours out of reach"), "secondary"));
  WayChoice<compensation::Clipping> clipping(clippings(), "clipping",
                                             PreviewPage::tr("Colours that the surface cannot show"), column);
  auto* black = new ValueRow(PreviewPage::tr("Lift of the blacks"));
  auto* lift = new QSlider(Qt::Horizontal);
  lift->setRange(0, 20);
  lift->setAccessibleName(PreviewPage::tr("Lift of the blacks, percent"));
  const QString leastLift = PreviewPage::tr("As little as hides where projectors end");
  auto* least = new Tick(leastLift);
  least->setObjectName("least-lift");
  column->addWidget(black);
  column->addWidget(lift);
  column->addWidget(least);

  auto apply = [&page](const QString& what, auto edit) {
    pipeline::ContentSettings settings = page.settings();
    edit(settings);
    page.setSettings(settings, what);
  };
  white.onChosen([apply](compensation::Brightness value) {
    apply(PreviewPage::tr("Brightness"), [value](pipeline::ContentSettings& s) { s.brightness = value; });
  });
  clipping.onChosen([apply](compensation::Clipping value) {
    apply(PreviewPage::tr("Colours out of reach"),
          [value](pipeline::ContentSettings& s) { s.clipping = value; });
  });
  QObject::connect(brightness, &QSlider::valueChanged, &page, [apply](int value) {
    apply(PreviewPage::tr("Brightness"),
          [value](pipeline::ContentSettings& s) { s.reachablePercentile = value; });
  });
  QObject::connect(lift, &QSlider::valueChanged, &page, [apply](int value) {
    apply(PreviewPage::tr("Lift of the blacks"),
          [value](pipeline::ContentSettings& s) { s.blackLift = value / 100.0; });
  });
  QObject::connect(least, &Tick::toggled, &page, [apply, &page](bool isLeast) {
    apply(PreviewPage::tr("Lift of the blacks"), [isLeast, &page](pipeline::ContentSettings& s) {
      s.blackLift.reset();
      if (!isLeast) s.blackLift = page.preview() ? page.preview()->blackLift : 0.0;
    });
  });
  auto refresh = [=, &page] {
    const pipeline::ContentSettings& settings = page.settings();
    white.show(settings.brightness);
    clipping.show(settings.clipping);
    QSignalBlocker quietBrightness(brightness), quietLift(lift), quietLeast(least);
    brightness->setValue(static_cast<int>(settings.reachablePercentile));
    // Of one projector there is nothing to hide.
    const bool isLeast = !settings.blackLift && page.projectors() > 1;
    const double found = page.preview() ? page.preview()->blackLift : 0.0;
    const double blackLift = settings.blackLift.value_or(isLeast ? found : 0.0);
    least->setVisible(page.projectors() > 1);
    least->setChecked(isLeast);
    setPossible(lift, isLeast ? leastLift : QString());
    lift->setValue(static_cast<int>(std::lround(100.0 * blackLift)));
    bright->setValue(percentText(settings.reachablePercentile / 100.0));
    black->setValue(percentText(blackLift));
  };
  refreshOn(page, part, refresh, &PreviewPage::settingsChanged, &PreviewPage::resultChanged);
  return part;
}

}  // namespace relucent::gui
