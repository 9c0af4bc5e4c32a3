// SPDX-License-Identifier: MIT
// A calibration's manifest and the documents beside it.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "fuzz/sample_calibration.h"
#include "fuzz/scratch.h"
#include "fuzz/targets.h"
#include "relucent/base/file.h"
#include "relucent/calibration/results.h"
#include "relucent/pipeline/acquisition_record.h"
#include "relucent/pipeline/drift_record.h"
#include "relucent/pipeline/masks_file.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/network_projectors.h"
#include "relucent/pipeline/night_record.h"
#include "relucent/pipeline/perfected.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/reductions.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/settings_json.h"
#include "relucent/pipeline/stills.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/pipeline/surprises_file.h"
#include "relucent/rehearsal/show_health.h"

namespace relucent::fuzz {
namespace fs = std::filesystem;
namespace {

using calibration::CalibrationFolder;
using Json = nlohmann::ordered_json;

/// The sample with another manifest, and what it once had changed in it.
const fs::path& changedCalibration() {
  static const fs::path folder = [] {
    fs::path path = scratch() / "changed";
    fs::copy(sampleCalibration(), path, fs::copy_options::recursive);
    return path;
  }();
  return folder;
}

std::vector<compensation::Mask> someMasks() {
  compensation::Mask first, second;
  first.points = {{0.1, 0.1}, {0.6, 0.2}, {0.4, 0.8}};
  second.points = {{0.0, 0.5}, {0.5, 0.5}, {0.5, 1.0}};
  return {first, second};
}

std::string withRig(const std::string& manifest, const pipeline::RigSettings& rig) {
  Json json = Json::parse(manifest);
  json["rig"] = pipeline::rigToJson(rig);
  return json.dump(1);
}

std::vector<std::string> madeManifests() {
  const fs::path& path = changedCalibration();
  const fs::path manifest = path / CalibrationFolder::manifestName;
  std::vector<std::string> seeds{readFile(manifest)};
  {
    // All that can be changed without measuring.
    CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
    pipeline::keepMasks(folder, someMasks());
    pipeline::saveSet(folder, "Morning");
    pipeline::saveSet(folder, "Evening");
    pipeline::NetworkProjectors projectors;
    projectors.addresses[0] = {"192.168.1.20", 4352, "secret"};
    pipeline::keepNetworkProjectors(folder, projectors);
  }
  seeds.push_back(readFile(manifest));
  pipeline::CommandRigSettings commands;
  commands.projectorCommand = "show {image}";
  commands.cameraCommand = "take {output}";
  commands.projector = {8, 8};
  commands.camera = Size{8, 8};
  commands.moreProjectors = {{"other {image}", {8, 8}}};
  commands.moreCameras = {{"other {output}", "", Size{8, 8}}};
  seeds.push_back(withRig(seeds.front(), commands));
  pipeline::ScreenRigSettings screen;
  screen.display.connector = "HDMI-1";
  screen.projector = {8, 8};
  screen.cameraAddress = "genicam:1";
  screen.moreScreens = {{screen.display, {8, 8}, 50.0, "left"}};
  screen.moreCameras = {{"genicam:2", Size{8, 8}, "gallery"}};
  seeds.push_back(withRig(seeds.front(), screen));
  seeds.push_back(withRig(seeds.front(), pipeline::ReplayRigSettings{"recorded"}));
  return seeds;
}

std::vector<std::string> manifestSeeds() {
  static const std::vector<std::string> made = madeManifests();
  return made;
}

void fuzzManifest(Bytes input) {
  const fs::path& path = changedCalibration();
  scratchFile(path / CalibrationFolder::manifestName, textOf(input));
  const CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  // Each of them, whatever the others say.
  std::exception_ptr first;
  const auto reads = [&first](const auto& read) {
    try {
      read();
    } catch (const Error&) {
      if (!first) first = std::current_exception();
    }
  };
  Progress quiet;
  reads([&] { pipeline::settingsOf(folder); });
  reads([&] { pipeline::measuredRigOf(folder); });
  reads([&] { pipeline::reductionsOf(folder); });
  reads([&] { pipeline::networkProjectorsOf(folder); });
  reads([&] { pipeline::setsOf(folder); });
  reads([&] { pipeline::fingerprintOfShown(folder); });
  reads([&] { calibration::resultsIn(folder); });
  reads([&] { pipeline::loadMeasurements(folder, quiet); });
  if (first) std::rethrow_exception(first);
}

/// As a writer does: settings are written again, with what they are made of.
void fuzzChangedManifest(Bytes input) {
  const fs::path& path = changedCalibration();
  scratchFile(path / CalibrationFolder::manifestName, textOf(input));
  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
  pipeline::saveSet(folder, "Night");
  pipeline::changeSettings(folder, pipeline::settingsOf(folder));
}

std::vector<std::string> acquisitionRecordSeeds() {
  pipeline::AcquisitionRecord record;
  record.seconds = 12.0;
  record.levels = {4, 16, 64};
  record.checks.resize(2);
  record.again.resize(1);
  pipeline::saveAcquisitionRecord(record, scratch());
  return {readFile(scratch() / pipeline::acquisitionRecordName)};
}
void fuzzAcquisitionRecord(Bytes input) {
  scratchFile(pipeline::acquisitionRecordName, textOf(input));
  pipeline::loadAcquisitionRecord(scratch());
}

std::vector<std::string> driftSeeds() {
  pipeline::saveDriftRecord({"2026-11-26T22:00:00Z", "2026-11-20T22:00:00Z"}, scratch());
  return {readFile(scratch() / pipeline::driftRecordName)};
}
void fuzzDrift(Bytes input) {
  scratchFile(pipeline::driftRecordName, textOf(input));
  pipeline::loadDriftRecord(scratch());
}

std::vector<std::string> proofSeeds() {
  pipeline::ProofRecord record;
  record.taken = record.measurement = "2026-11-26T22:00:00Z";
  record.figures.others.resize(1);
  pipeline::saveProofRecord(record, scratch());
  return {readFile(scratch() / "proof.json")};
}
void fuzzProof(Bytes input) {
  scratchFile("proof.json", textOf(input));
  pipeline::loadProofRecord(scratch());
}

std::vector<std::string> nightSeeds() {
  std::error_code ignored;
  fs::remove(scratch() / pipeline::nightsName, ignored);
  pipeline::NightRecord quiet, bad;
  quiet.when = bad.when = "2026-11-26T22:00:00Z";
  quiet.measured = quiet.predicted = pipeline::PictureError{30.0, 1.0};
  bad.alarm = RELUCENT_ENGLISH_MESSAGE("test.full", "the disk of {} is full, {} are left")
                  .with("here", as::bytes(std::uint64_t{3}));
  bad.what = {bad.alarm};
  pipeline::addNight(scratch(), quiet);
  std::vector<std::string> seeds{readFile(scratch() / pipeline::nightsName)};
  pipeline::addNight(scratch(), bad);
  seeds.push_back(readFile(scratch() / pipeline::nightsName));
  seeds.push_back(seeds.back().substr(seeds.front().size()));
  return seeds;
}
void fuzzNights(Bytes input) {
  scratchFile(pipeline::nightsName, textOf(input));
  for (const pipeline::NightRecord& night : pipeline::nightsOf(scratch())) {
    english(night.alarm);
    for (const Message& message : night.what) english(message);
  }
}

std::vector<std::string> perfectedSeeds() {
  pipeline::PerfectedPicture picture;
  picture.key = "0123";
  picture.folder = scratch();
  picture.picture = "a.png";
  picture.perfected = "2026-11-26T22:00:00Z";
  picture.figures.before.resize(1);
  picture.figures.after.resize(1);
  picture.canvas = compensation::ContentCanvas{};
  return {readFile(
      pipeline::savePerfected(picture, ProjectorStack(Stack(3 * 64, 0.5f)), Rasters(Size{8, 8})).front())};
}
void fuzzPerfected(Bytes input) {
  static const fs::path record = [] {
    perfectedSeeds();
    for (const fs::directory_entry& entry :
         fs::directory_iterator(pipeline::perfectedFolder(scratch()) / "0123"))
      if (entry.path().extension() == ".json") return entry.path();
    return fs::path();
  }();
  scratchFile(record, textOf(input));
  if (const auto found = pipeline::findPerfected(scratch(), "0123"))
    pipeline::driveOf(*found, Rasters(Size{8, 8}));
}

std::vector<std::string> maskSeeds() {
  const fs::path path = scratch() / "seed.masks";
  pipeline::writeMasks(path, someMasks());
  return {readFile(path)};
}
void fuzzMasks(Bytes input) {
  pipeline::readMasks(scratchFile("input.masks", textOf(input)));
}

std::vector<std::string> stillSeeds() {
  return {R"({"version": 2, "loop": true, "fade_seconds": 1, "items": [{"path": "a.png", "seconds": 10},)"
          R"({"path": "stream:rtsp://host/live"}, {"path": "../b.exr", "set": "Evening"}],)"
          R"("sets": [{"from": "18:00", "set": "Evening"}]})"};
}
void fuzzStills(Bytes input) {
  pipeline::stillsOf(scratchFile("input.playlist", textOf(input)));
}

std::vector<std::string> passwordSeeds() {
  return {R"({"version": 1, "passwords": {"1": "secret", "2": "other"}})"};
}
void fuzzPasswords(Bytes input) {
  static const fs::path path = [] {
    manifestSeeds();
    fs::path with = scratch() / "with-projectors";
    fs::create_directories(with);
    CalibrationFolder folder = CalibrationFolder::create(
        with, pipeline::rigToJson(pipeline::ReplayRigSettings{"recorded"}), Json::object());
    pipeline::NetworkProjectors projectors;
    projectors.addresses[0] = {"192.168.1.20"};
    pipeline::keepNetworkProjectors(folder, projectors);
    return with;
  }();
  scratchFile(path / pipeline::passwordFile, textOf(input));
  pipeline::networkProjectorsOf(CalibrationFolder::open(path, CalibrationFolder::Access::read));
}

std::vector<std::string> surpriseSeeds() {
  using venue::Surprise;
  venue::SurpriseSettings settings;
  settings.kinds = {Surprise::bump, Surprise::roomLight, Surprise::unplugged};
  pipeline::saveSurprises(venue::Surprises(settings, {{Surprise::bump}, {Surprise::roomLight}, 3, 2}),
                          scratch());
  return {readFile(scratch() / pipeline::surprisesName)};
}
void fuzzSurprises(Bytes input) {
  scratchFile(pipeline::surprisesName, textOf(input));
  const auto surprises = pipeline::loadSurprises(scratch());
  if (!surprises) return;
  for (int pattern = 0; pattern < 100; ++pattern) surprises->during({"acquisition", pattern});
  for (int look = 0; look < 10; ++look) surprises->during({"nudge", look});
  surprises->putRight();
}

std::vector<std::string> healthSeeds() {
  return {
      R"({"updated": "2026-11-26T22:00:00Z", "state": "playing", "item": 0, "failures": 0, "skipped": [],)"
      R"("displays": [{"shining": true, "power": "on"}], "projectors": [{"power": "on"}],)"
      R"("night": {"when": "2026-11-26T03:00:00Z", "alarm": "look"}, "streams": [{"state": "lost"}]})"};
}
void fuzzHealth(Bytes input) {
  rehearsal::showHealthFrom(textOf(input));
}

}  // namespace

std::vector<FuzzTarget> calibrationTargets() {
  return {{"manifest", fuzzManifest, manifestSeeds, Form::json, 250},
          {"changed manifest", fuzzChangedManifest, manifestSeeds, Form::json, 250},
          {"acquisition record", fuzzAcquisitionRecord, acquisitionRecordSeeds, Form::json, 800},
          {"drift", fuzzDrift, driftSeeds, Form::json, 500},
          {"proof", fuzzProof, proofSeeds, Form::json, 800},
          {"nights", fuzzNights, nightSeeds, Form::jsonLine, 800},
          {"perfected", fuzzPerfected, perfectedSeeds, Form::json, 500},
          {"masks", fuzzMasks, maskSeeds, Form::json, 800},
          {"stills", fuzzStills, stillSeeds, Form::json, 500},
          {"projectors' passwords", fuzzPasswords, passwordSeeds, Form::json, 300},
          {"surprises", fuzzSurprises, surpriseSeeds, Form::json, 500},
          {"health", fuzzHealth, healthSeeds, Form::json, 500}};
}

}  // namespace relucent::fuzz
