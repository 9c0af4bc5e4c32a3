// SPDX-License-Identifier: MIT
#include "wizard/output/proof_file.h"

#include "relucent/image/exr.h"
#include "relucent/pipeline/proof_record.h"

namespace relucent::gui {
namespace {

namespace fs = std::filesystem;

QImage read(const fs::path& file) {
  return QImage(QString::fromStdString(file.string()));
}

}  // namespace

fs::path proofFolder(const fs::path& calibration) {
  return calibration / "verification";
}

void saveProof(const Proof& proof, const fs::path& folder) {
  pipeline::saveProofRecord({proof.taken.toUTC().toString(Qt::ISODate).toStdString(), proof.measured,
                             proof.shownFrom, proof.content, proof.figures},
                            folder);
}

std::shared_ptr<const Proof> loadProof(const fs::path& folder) {
  try {
    const std::optional<pipeline::ProofRecord> record = pipeline::loadProofRecord(folder);
    if (!record) return nullptr;
    auto proof = std::make_shared<Proof>();
    proof->taken = QDateTime::fromString(QString::fromStdString(record->taken), Qt::ISODate).toLocalTime();
    proof->measured = record->measurement;
    proof->shownFrom = record->shownFrom;
    proof->content = record->content;
    proof->figures = record->figures;
    proof->wanted = read(folder / "target.png");
    proof->photograph = read(folder / "after.png");
    proof->deltaE = image::readExr(folder / "after_delta_e.exr").pixels;
    const QSize size(proof->deltaE.size().width, proof->deltaE.size().height);
    return proof->wanted.size() == size && proof->photograph.size() == size ? proof : nullptr;
  } catch (const std::exception&) {
    return nullptr;  // it is taken again, and nothing else is lost
  }
}

std::optional<pipeline::DriftRecord> loadDrift(const fs::path& folder) {
  try {
    return pipeline::loadDriftRecord(folder);
  } catch (const std::exception&) {
    return std::nullopt;  // it is checked again
  }
}

void forgetDrift(const fs::path& folder) {
  std::error_code missing;
  fs::remove(folder / pipeline::driftRecordName, missing);
}

}  // namespace relucent::gui
