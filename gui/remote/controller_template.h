// SPDX-License-Identifier: MIT
#pragma once

#include <QByteArray>

#include "relucent/base/enum_names.h"
#include "remote/network_place.h"

namespace relucent::gui {

/// For whom the table of OSC addresses is written.
enum class ControllerFormat {
  openStageControl,  // a session of Open Stage Control, JSON
  csv,               // a table, for whatever else is set up by hand or by a script
};
inline constexpr EnumName<ControllerFormat> controllerFormatNames[]{
    {ControllerFormat::openStageControl, "open-stage-control"}, {ControllerFormat::csv, "csv"}};
constexpr EnumNames<ControllerFormat> namesOf(ControllerFormat) {
  return {"format of a controller", controllerFormatNames};
}

/// All of remoteCommands() for a controller that sends to `show`, in UTF-8.
///   openStageControl  a widget each: address, target, type tags, and what it may send
///   csv               address, type tags, least, most, choices (separated by spaces), what it does
/// Source: Open Stage Control 1.25, reference of its widgets.
QByteArray controllerTemplate(ControllerFormat format, const NetworkPlace& show);

}  // namespace relucent::gui
