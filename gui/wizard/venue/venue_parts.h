// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <QWidget>

namespace relucent::gui {

class VenuePage;

/// What the first page is made of: a stage for each of its modes, and what stands beside it.
QWidget* startStage(VenuePage& model);
QWidget* rehearseStage(VenuePage& model);
QWidget* rehearseInspector(VenuePage& model);
QWidget* scriptStage(VenuePage& model);
QWidget* scriptInspector(VenuePage& model);
QWidget* devicesStage(VenuePage& model);
QWidget* devicesInspector(VenuePage& model);
/// Another screen for the calibration that is open.
QWidget* screenStage(VenuePage& model);
QWidget* screenInspector(VenuePage& model);
/// Other commands for the calibration that is open, where it has any.
QWidget* programsStage(VenuePage& model);
QWidget* programsInspector(VenuePage& model);
/// What such a command has to do.
QString showingProgram();
QString photographingProgram();
/// A list of screens is shown where one has to be chosen first.
void pointOutScreens(VenuePage& model, QWidget* list);
/// The warning of flashing light with its tick, for venues that are begun with real devices.
QWidget* consentToBegin(VenuePage& model);
/// Name, folder, and what it will take: the same for every kind of new venue.
QWidget* keepingPart(VenuePage& model);

}  // namespace relucent::gui
