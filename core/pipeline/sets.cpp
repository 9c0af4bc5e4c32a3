// SPDX-License-Identifier: MIT
#include "relucent/pipeline/sets.h"

#include <algorithm>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/calibration/json.h"
#include "relucent/pipeline/masks_file.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/settings_json.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::pipeline {
namespace {

using calibration::CalibrationFolder;
using calibration::Json;

/// In a manifest's settings; no fingerprint knows it.
///   {"version", "in_use", "sets": [{"name", "content"}, ...]}
/// The set in use has no content there: that is the calibration's.
constexpr const char* section = "sets";
constexpr int setsVersion = 1;

[[noreturn]] void failDamaged(const CalibrationFolder& folder) {
  throw Error(ErrorKind::format,
              RELUCENT_MESSAGE("sets.damaged", "the sets of this calibration cannot be read"),
              RELUCENT_MESSAGE("sets.remove-section",
                               "take \"sets\" out of the settings in {}, or copy the calibration again from "
                               "where it was made")
                  .with(CalibrationFolder::manifestName),
              folder.path().string());
}

std::size_t indexOf(const TargetSets& sets, const std::string& name, const CalibrationFolder& folder) {
  const auto found = std::ranges::find(sets.all, name, &TargetSet::name);
  if (found != sets.all.end()) return static_cast<std::size_t>(found - sets.all.begin());
  std::string known;
  for (const TargetSet& set : sets.all) known += (known.empty() ? "" : ", ") + set.name;
  throw Error(ErrorKind::input, RELUCENT_MESSAGE("sets.unknown", "there is no set '{}'").with(name),
              known.empty()
                  ? RELUCENT_MESSAGE("sets.save-first", "this calibration has no sets yet: save one first")
                  : RELUCENT_MESSAGE("sets.choose-one", "choose one of {}").with(known),
              folder.path().string());
}

void requireName(const std::string& name) {
  if (const Message wrong = problemOfSetName(name); !wrong.empty())
    throw Error(ErrorKind::input, wrong,
                RELUCENT_MESSAGE("sets.choose-name", "choose another name, as day or school class"));
}

void requireNew(const TargetSets& sets, const std::string& name, const CalibrationFolder& folder) {
  if (std::ranges::count(sets.all, name, &TargetSet::name) > 0)
    throw Error(ErrorKind::input,
                RELUCENT_MESSAGE("sets.name-taken", "there is a set '{}' already").with(name),
                RELUCENT_MESSAGE("sets.choose-name", "choose another name, as day or school class"),
                folder.path().string());
}

/// A manifest's settings with these sets, and the content of the one in use.
Json settingsWith(Json settings, const TargetSets& sets) {
  if (sets.all.empty()) {
    settings.erase(section);
  } else {
    settings["content"] = contentToJson(sets.all[sets.inUse].content);
    Json list = Json::array();
    for (std::size_t i = 0; i < sets.all.size(); ++i) {
      list.push_back({{"name", sets.all[i].name}});
      if (i != sets.inUse) list.back()["content"] = contentToJson(sets.all[i].content);
    }
    settings[section] = {{"version", setsVersion}, {"in_use", sets.nameInUse()}, {"sets", std::move(list)}};
  }
  return settings;
}

void keep(CalibrationFolder& folder, const TargetSets& sets) {
  folder.setSettings(settingsWith(folder.settings(), sets));
}

std::string contentIn(const Json& settings) {
  Json sections = Json::object();
  for (const char* each : {"content", section})
    if (settings.contains(each)) sections[each] = settings.at(each);
  return sections.dump();
}

bool isUtf8(const std::string& text) {
  try {
    return !Json(text).dump().empty();
  } catch (const Json::type_error&) {
    return false;
  }
}

}  // namespace

std::vector<std::string> TargetSets::names() const {
  std::vector<std::string> names;
  for (const TargetSet& set : all) names.push_back(set.name);
  return names;
}

Message problemOfSetName(const std::string& name) {
  if (name.empty()) return RELUCENT_MESSAGE("sets.name-empty", "a set needs a name");
  if (name.size() > longestSetName)
    return RELUCENT_MESSAGE("sets.name-too-long", "the name of a set has at most {} bytes")
        .with(longestSetName);
  const bool hasControl = std::ranges::any_of(name, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
  });
  if (hasControl || name.front() == ' ' || name.back() == ' ' || !isUtf8(name))
    return RELUCENT_MESSAGE("sets.name-odd",
                            "the name of a set is plain text that neither begins nor ends with a space");
  return {};
}

TargetSets setsOf(const CalibrationFolder& folder) {
  TargetSets sets;
  if (!folder.settings().contains(section)) return sets;
  try {
    const Json& written = folder.settings().at(section);
    if (written.value("version", setsVersion) > setsVersion)
      throw Error(
          ErrorKind::format,
          RELUCENT_MESSAGE("sets.of-newer-version", "a newer Relucent wrote the sets of this calibration"),
          RELUCENT_ENGLISH_MESSAGE("calibration.update-relucent",
                                   "open it with that version, or update this one"),
          folder.path().string());
    const auto inUse = written.at("in_use").get<std::string>();
    bool isUsed = false;
    for (const Json& entry : written.at("sets")) {
      TargetSet set;
      set.name = entry.at("name").get<std::string>();
      const bool isKnown = std::ranges::count(sets.all, set.name, &TargetSet::name) > 0;
      if (!problemOfSetName(set.name).empty() || isKnown) failDamaged(folder);
      if (set.name == inUse) {
        isUsed = true;
        sets.inUse = sets.all.size();
        set.content = settingsOf(folder).content;
      } else {
        set.content = contentFromJson(entry.at("content"));
        if (!problems(set.content).empty()) failDamaged(folder);
      }
      sets.all.push_back(std::move(set));
    }
    if (!isUsed) failDamaged(folder);
  } catch (const Json::exception&) {
    failDamaged(folder);
  }
  return sets;
}

void saveSet(CalibrationFolder& folder, const std::string& name) {
  requireName(name);
  TargetSets sets = setsOf(folder);
  const ContentSettings content = settingsOf(folder).content;
  if (name == sets.nameInUse()) return;
  requireNew(sets, name, folder);
  sets.inUse = sets.all.size();
  sets.all.push_back({name, content});
  keep(folder, sets);
}

void useSet(CalibrationFolder& folder, const std::string& name) {
  TargetSets sets = setsOf(folder);
  sets.inUse = indexOf(sets, name, folder);
  keep(folder, sets);
}

void renameSet(CalibrationFolder& folder, const std::string& from, const std::string& to) {
  requireName(to);
  TargetSets sets = setsOf(folder);
  const std::size_t renamed = indexOf(sets, from, folder);
  if (from != to) requireNew(sets, to, folder);
  sets.all[renamed].name = to;
  keep(folder, sets);
}

void removeSet(CalibrationFolder& folder, const std::string& name) {
  TargetSets sets = setsOf(folder);
  const std::size_t removed = indexOf(sets, name, folder);
  if (removed == sets.inUse && sets.all.size() > 1)
    throw Error(ErrorKind::input, RELUCENT_MESSAGE("sets.in-use", "the set '{}' is in use").with(name),
                RELUCENT_MESSAGE("sets.use-another-first", "use another one first"), folder.path().string());
  sets.all.erase(sets.all.begin() + static_cast<std::ptrdiff_t>(removed));
  if (removed < sets.inUse) --sets.inUse;
  keep(folder, sets);
}

CalibrationFolder openWithSet(const std::filesystem::path& path, const std::string& name) {
  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  if (name.empty()) return folder;
  TargetSets sets = setsOf(folder);
  Json settings = folder.settings();
  settings["content"] = contentToJson(sets.all[indexOf(sets, name, folder)].content);
  folder.readAs(std::move(settings));
  return folder;
}

compensation::TargetSettings targetIn(const CalibrationFolder& folder, const std::string& set,
                                      const compensation::TargetSettings& otherwise) {
  return set.empty() ? withMasks(otherwise, folder) : targetOf(settingsOf(folder).content);
}

std::string contentSections(const CalibrationFolder& folder,
                            const std::function<ContentSettings(const ContentSettings&)>& change) {
  TargetSets sets = setsOf(folder);
  if (!sets.all.empty()) {
    for (TargetSet& set : sets.all) set.content = change(set.content);
    return contentIn(settingsWith(folder.settings(), sets));
  }
  Json settings = folder.settings();
  settings["content"] = contentToJson(change(settingsOf(folder).content));
  return contentIn(settings);
}

Json toJson(const TargetSets& sets) {
  Json list = Json::array();
  for (const TargetSet& set : sets.all)
    list.push_back({{"name", set.name}, {"content", contentToJson(set.content)}});
  return {{"in_use", sets.nameInUse()}, {"sets", std::move(list)}};
}

std::vector<std::string> fingerprintsOfSets(const CalibrationFolder& folder) {
  std::vector<std::string> fingerprints{fingerprintOfShown(folder)};
  for (const TargetSet& set : setsOf(folder).all)
    fingerprints.push_back(fingerprintOfShown(folder, set.content));
  return fingerprints;
}

}  // namespace relucent::pipeline
