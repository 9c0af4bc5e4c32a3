// SPDX-License-Identifier: MIT
#include "wizard/devices/identify_overlay.h"

#include <QFontMetrics>
#include <QGuiApplication>
#include <QPainter>
#include <QRasterWindow>
#include <algorithm>
#include <array>
#include <cmath>

#include "output/screen_identity.h"
#include "theme/theme.h"

namespace relucent::gui {
namespace {

QList<QScreen*> projectorScreens() {
  QList<QScreen*> screens = QGuiApplication::screens();
  screens.removeOne(QGuiApplication::primaryScreen());
  std::sort(screens.begin(), screens.end(), [](const QScreen* a, const QScreen* b) {
    return std::pair(a->geometry().x(), a->geometry().y()) < std::pair(b->geometry().x(), b->geometry().y());
  });
  return screens;
}

/// Lines as wide as the gaps between them, upright and lying.
void drawLines(QPainter& painter, QPoint place, int width, int side) {
  for (int at = 0; at + width <= side; at += 2 * width) {
    painter.fillRect(QRect(place.x() + at, place.y(), width, side), painter.pen().color());
    painter.fillRect(QRect(place.x() + side + side / 4, place.y() + at, side, width), painter.pen().color());
  }
}

/// How far inside the edge its lines are, pixels.
constexpr std::array frame{0, 10, 20};

/// What one screen shows, in its own pixels.
class ScreenCard : public QRasterWindow {
 public:
  explicit ScreenCard(QScreen* screen) : number_(screenNumber(*screen)), title_(screenTitle(*screen)) {
    setFlags(Qt::Window | Qt::FramelessWindowHint | Qt::WindowStaysOnTopHint | Qt::WindowDoesNotAcceptFocus);
    setTitle(title_);
    setScreen(screen);
    setGeometry(screen->geometry());
    size_ = nativeSize(*screen);
    about_ = IdentifyOverlay::tr("%1, %2 × %3, %4 Hz")
                 .arg(screen->name())
                 .arg(size_.width())
                 .arg(size_.height())
                 .arg(std::lround(screen->refreshRate()));
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Colours& dark = colours(Look::dark);
    QPainter painter(this);
    painter.scale(1.0 / devicePixelRatio(), 1.0 / devicePixelRatio());
    painter.fillRect(QRect(QPoint(), size_), Qt::black);
    painter.setPen(QPen(dark.accent, 1));
    // The outermost pixels, and every tenth within: what is missing is cut off.
    for (int inset : frame)
      painter.drawRect(QRect(QPoint(inset, inset), size_ - QSize(2 * inset + 1, 2 * inset + 1)));
    // Upright screens have room for it too.
    const int unit = (std::min(size_.height(), size_.width()) - 2 * frame.back()) / 22;
    const int top = (size_.height() - 25 * unit) / 2, widest = size_.width() - 2 * (frame.back() + unit);
    auto write = [&](double row, int pixels, int weight, const QColor& colour, const QString& text) {
      QFont font = typeOf(std::max(8, pixels), weight);
      if (const int width = QFontMetrics(font).horizontalAdvance(text); width > widest)
        font.setPixelSize(std::max(1, font.pixelSize() * widest / width));
      painter.setFont(font);
      painter.setPen(colour);
      painter.drawText(QRectF(0, top + row * unit, size_.width(), 2.0 * pixels),
                       Qt::AlignHCenter | Qt::AlignTop, text);
    };
    write(3, 10 * unit, QFont::DemiBold, dark.accent, QString::number(number_));
    write(14.5, 2 * unit, QFont::DemiBold, dark.text, title_);
    write(16.8, unit, QFont::Normal, dark.secondary, about_);
    write(21.2, 3 * unit / 4, QFont::Normal, dark.secondary,
          IdentifyOverlay::tr("Lines sharp? Then this is the projector's own resolution."));
    painter.setPen(dark.secondary);
    int side = 2 * unit & ~7, group = 3 * side, left = (size_.width() - 3 * group + group / 4) / 2;
    for (int width : {1, 2, 4}) {
      drawLines(painter, {left, top + static_cast<int>(18.8 * unit)}, width, side);
      left += group;
    }
  }

 private:
  int number_;
  QString title_, about_;
  QSize size_;
};

}  // namespace

int screenNumber(const QScreen& screen) {
  const QList<QScreen*> screens = projectorScreens();
  return static_cast<int>(std::find(screens.begin(), screens.end(), &screen) - screens.begin()) + 1;
}

QString screenTitle(const QScreen& screen) {
  return IdentifyOverlay::tr("Screen %1").arg(screenNumber(screen));
}

IdentifyOverlay::IdentifyOverlay(QObject* parent) : QObject(parent) {
  leaving_.setSingleShot(true);
  leaving_.setInterval(milliseconds);
  connect(&leaving_, &QTimer::timeout, this, &IdentifyOverlay::hide);
  // A window whose screen goes would move to the operator's.
  connect(qGuiApp, &QGuiApplication::screenRemoved, this, &IdentifyOverlay::hide);
  if (parent != nullptr) parent->installEventFilter(this);
}

IdentifyOverlay::~IdentifyOverlay() = default;

void IdentifyOverlay::show() {
  hide();
  for (QScreen* screen : projectorScreens()) {
    windows_.push_back(std::make_unique<ScreenCard>(screen));
    // showFullScreen() would ask for the keys.
    windows_.back()->setWindowStates(Qt::WindowFullScreen);
    windows_.back()->setVisible(true);
  }
  leaving_.start();
}

void IdentifyOverlay::hide() {
  leaving_.stop();
  // Not only away: the program ends when the last window is closed.
  for (const auto& window : windows_) window->close();
  windows_.clear();
}

bool IdentifyOverlay::eventFilter(QObject* watched, QEvent* event) {
  if (watched == parent() && event->type() == QEvent::Hide) hide();
  return QObject::eventFilter(watched, event);
}

}  // namespace relucent::gui
