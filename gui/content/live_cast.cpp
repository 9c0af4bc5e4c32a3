// SPDX-License-Identifier: MIT
#include "content/live_cast.h"

#include "content/cast_choices.h"
#include "desktop/cast_failure.h"

namespace relucent::gui {
namespace {

class CastFeed : public LiveFeed {
 public:
  CastFeed(const ScreenCastWish& wish, const ScreenCastVisitor& visitor) : cast_(wish, visitor) {}
  const QString& token() const { return cast_.token(); }
  LivePicture next() override {
    ScreenCast::Picture picture = cast_.next();
    return {std::move(picture.image), picture.arrived};
  }

 private:
  ScreenCast cast_;
};

QString pathOf(ScreenCastWish::What what, const QString& which) {
  return (what == ScreenCastWish::What::screen ? "screen:" : "window:") + which;
}

}  // namespace

LiveCast::LiveCast(ScreenCastWish::What what, const QString& which, const Canvas& canvas,
                   Attendance attendance, const CastPatience& patience, const LivePauses& pauses)
    : LiveLink(
          [what, path = pathOf(what, which), attendance, patience](const Opening& opening) {
            ScreenCastWish wish{what, castChoice(path)};
            const bool isAlone = attendance == Attendance::unattended, wasChosen = !wish.token.isEmpty();
            wish.connection = patience.connection;
            if (isAlone) wish.dialog = wasChosen ? patience.refusal : patience.question;
            try {
              auto feed =
                  std::make_unique<CastFeed>(wish, ScreenCastVisitor{opening.isUnwanted, opening.isAsked});
              keepCastChoice(path, feed->token());
              return feed;
            } catch (const NotChosen& error) {
              throw LiveFeed::RarelyMended(
                  error, isAlone && wasChosen ? patience.again : LiveFeed::RarelyMended::never);
            }
          },
          pathOf(what, which), false, canvas, pauses) {}

}  // namespace relucent::gui
