// SPDX-License-Identifier: MIT
#include "wizard/output/proof_file.h"

#include "base/file.h"
#include "calibration/json.h"
#include "image/exr.h"
#include "pipeline/settings_json.h"

namespace relucent {
namespace {

namespace fs = std::filesystem;

Json toJson(const PictureError& error) {
  return {{"psnr", error.psnr}, {"delta_e", error.deltaE}};
}
PictureError errorFrom(const Json& json) {
  return {json.at("psnr").get<double>(), json.at("delta_e").get<double>()};
}

Json toJson(const ProvedProjection& projection) {
  return {{"predicted", toJson(projection.predicted)},
          {"measured", toJson(projection.measured)},
          {"surprise", projection.surprise}};
}
ProvedProjection projectionFrom(const Json& json) {
  return {errorFrom(json.at("predicted")), errorFrom(json.at("measured")), json.at("surprise").get<double>()};
}

Json toJson(const ContentSettings& content) {
  CalibrateSettings settings;
  settings.content = content;
  return {{"content", stagesToJson(settings).at("content")}};
}
ContentSettings contentFrom(const Json& json) {
  CalibrateSettings settings;
  stagesFromJson(json, settings);
  return settings.content;
}

QImage read(const fs::path& file) {
  return QImage(QString::fromStdString(file.string()));
}

}  // namespace

fs::path proofFolder(const fs::path& calibration) {
  return calibration / "verification";
}

void saveProof(const Proof& proof, const fs::path& folder) {
  const Json json{{"taken", proof.taken.toUTC().toString(Qt::ISODate).toStdString()},
                  {"measurement", proof.measured},
                  {"settings", toJson(proof.content)},
                  {"method", nameOf(proof.figures.method)},
                  {"before", toJson(proof.figures.before)},
                  {"after", toJson(proof.figures.after)},
                  {"reachable", proof.figures.reachable}};
  writeFileAtomically(folder / "proof.json", json.dump(2));
}

std::shared_ptr<const Proof> loadProof(const fs::path& folder) {
  try {
    if (!fs::exists(folder / "proof.json")) return nullptr;
    const Json json = Json::parse(readFile(folder / "proof.json"));
    auto proof = std::make_shared<Proof>();
    proof->taken = QDateTime::fromString(QString::fromStdString(json.at("taken")), Qt::ISODate).toLocalTime();
    proof->measured = json.at("measurement").get<std::string>();
    proof->content = contentFrom(json.at("settings"));
    proof->figures.method = parsedName<Method>(json.at("method").get<std::string>(), ErrorKind::format);
    proof->figures.before = projectionFrom(json.at("before"));
    proof->figures.after = projectionFrom(json.at("after"));
    proof->figures.reachable = json.at("reachable").get<double>();
    proof->wanted = read(folder / "target.png");
    proof->photograph = read(folder / "after.png");
    proof->deltaE = readExr(folder / "after_delta_e.exr").pixels;
    const QSize size(proof->deltaE.size().width, proof->deltaE.size().height);
    return proof->wanted.size() == size && proof->photograph.size() == size ? proof : nullptr;
  } catch (const std::exception&) {
    return nullptr;  // it is taken again, and nothing else is lost
  }
}

}  // namespace relucent
