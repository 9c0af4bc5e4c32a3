// SPDX-License-Identifier: MIT
#include "relucent/pipeline/plan.h"

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/image/picture_files.h"
#include "relucent/importing/pattern_plan.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

std::string patternNameOf(std::size_t number, const importing::PlannedPattern& pattern) {
  return fmt::format("{:03}-{}.png", number, importing::toString(pattern.kind));
}

calibration::Json describe(const std::string& file, const importing::PlannedPattern& pattern) {
  using Kind = importing::PlannedPattern::Kind;
  calibration::Json json{{"file", file}, {"kind", importing::toString(pattern.kind)}};
  if (pattern.kind == Kind::ramp) {
    json["channel"] = std::array{"red", "green", "blue"}.at(static_cast<std::size_t>(pattern.channel));
    json["level"] = pattern.level;
  }
  if (pattern.kind == Kind::columns || pattern.kind == Kind::rows) {
    json["bit"] = pattern.bit;
    json["negative"] = pattern.negative;
  }
  if (pattern.kind == Kind::random) json["block"] = pattern.block;
  return json;
}

std::string instructions(const importing::PatternPlanSettings& settings, std::size_t count) {
  return fmt::format(
      "How to photograph these {0} patterns with a camera that nothing connects to the projector\n"
      "\n"
      "1. Projector: {1}x{2} pixels, shown pixel by pixel: no scaling, no keystone correction, no picture\n"
      "   enhancement, no dynamic lamp. Let it warm up for half an hour.\n"
      "2. Camera: on a tripod; exposure, aperture, focus, sensitivity and white balance by hand and never "
      "changed.\n"
      "   Choose the exposure so that 001-white.png is nowhere overexposed. Photograph at least one full "
      "turn of a\n"
      "   colour wheel (1/30 s or longer). Let it write raw files: they are read as they are.\n"
      "3. Darken the room. Show the pictures one after the other, in the order of their names, each longer "
      "than\n"
      "   the intervalometer's interval, or photograph by hand. Take one photograph of each.\n"
      "4. Sort out photographs until there are {0}. Raw files count in the order in which they were taken, "
      "others in\n"
      "   the order of their names.\n"
      "5. relucent-cli import CALIBRATION --patterns THIS_FOLDER --photographs FOLDER_OF_PHOTOGRAPHS\n",
      count, settings.projector.width, settings.projector.height);
}

void checkHoldsNoPlan(const fs::path& out) {
  std::error_code code;
  if (fs::exists(out, code) &&
      (!fs::is_directory(out, code) || fs::directory_iterator(out, code) != fs::directory_iterator()))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("disk.name-taken", "there is something of this name already"),
                RELUCENT_ENGLISH_MESSAGE("disk.choose-empty-folder", "choose a new or an empty folder"),
                out.string());
}

}  // namespace

WrittenFiles exportPlan(const importing::PatternPlanSettings& settings, const fs::path& out,
                        Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  checkHoldsNoPlan(out);
  createFolder(out);
  std::vector<importing::PlannedPattern> plan = importing::planPatterns(settings);
  WrittenFiles written;
  calibration::Json list = calibration::Json::array();
  for (std::size_t k = 0; k < plan.size(); ++k) {
    std::string name = patternNameOf(k, plan[k]);
    image::writePng(out / name, render(plan[k], settings.projector), 8);
    list.push_back(describe(name, plan[k]));
    written.files.push_back(out / name);
    progress.report(static_cast<double>(k + 1) / static_cast<double>(plan.size()));
  }
  calibration::Json manifest{{"projector", {settings.projector.width, settings.projector.height}},
                             {"seed", settings.seed},
                             {"patterns", std::move(list)}};
  writeFileAtomically(out / "plan.json", manifest.dump(2) + "\n");
  writeFileAtomically(out / "instructions.txt", instructions(settings, plan.size()));
  written.files.push_back(out / "plan.json");
  written.files.push_back(out / "instructions.txt");
  return written;
}

}  // namespace relucent::pipeline
