// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "jobs/failure.h"
#include "relucent/image/image.h"

namespace relucent::gui {

class Card;
class PlaneView;

/// What a view can save besides its picture.
struct ViewValues {
  std::function<image::Image()> values;  // empty: there are none now
  std::string units;
};

/// Adds buttons to a card's header: fit to view, full screen, save the visible picture as PNG or its values
/// as OpenEXR. `failed` is called when saving fails.
void addViewActions(Card& card, PlaneView& view, ViewValues values,
                    const std::function<void(const Failure&)>& failed);

/// One of several views in a card.
struct ShownView {
  PlaneView& view;
  ViewValues values;
};
/// One button with all of that, for a card that shows one of several views at a time: `shown` says which one
/// it is then.
void addViewMenu(Card& card, const std::function<ShownView()>& shown,
                 const std::function<void(const Failure&)>& failed);

/// Where a view is saved unless somebody says otherwise: the pictures' folder, a name after the venue and
/// what the view shows, that every file system takes. `venue`: its folder, which a window tells as
/// windowFilePath(); empty: none is open. `ending`: with its dot.
QString suggestedFile(const QString& venue, const QString& shown, const QString& ending);

/// What the view shows, or its numbers, by the name's ending: .png or .exr.
/// Throws: Error{input} for another ending or without numbers, Error{disk}.
void saveView(PlaneView& view, const ViewValues& values, const QString& path);

}  // namespace relucent::gui
