// SPDX-License-Identifier: MIT
#include "wizard/output/proof_file.h"

#include <algorithm>

#include "relucent/image/exr.h"
#include "text/written_times.h"

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

std::vector<ProofView> proofViews(const fs::path& folder, std::size_t cameras) {
  std::vector<ProofView> views;
  for (std::size_t camera = 0; camera < cameras; ++camera)
    views.push_back({read(pipeline::proofPicture(folder, "target", camera, ".png")),
                     read(pipeline::proofPicture(folder, "after", camera, ".png")),
                     image::readExr(pipeline::proofPicture(folder, "after", camera, "_delta_e.exr")).pixels});
  return views;
}

pipeline::ProofRecord recordOf(const Proof& proof) {
  return {written(proof.taken), proof.measured, proof.shownFrom,
          proof.content,        proof.figures,  proof.picture.toStdString()};
}

void saveProof(const Proof& proof, const fs::path& folder) {
  pipeline::saveProofRecord(recordOf(proof), folder);
}

std::shared_ptr<const Proof> loadProof(const fs::path& folder) {
  try {
    const std::optional<pipeline::ProofRecord> record = pipeline::loadProofRecord(folder);
    if (!record) return nullptr;
    auto proof = std::make_shared<Proof>();
    proof->taken = timeWritten(record->taken).toLocalTime();
    proof->measured = record->measurement;
    proof->shownFrom = record->shownFrom;
    proof->picture = QString::fromStdString(record->picture);
    proof->content = record->content;
    proof->figures = record->figures;
    proof->views = proofViews(folder, proof->figures.others.size() + 1);
    const bool areWhole = std::ranges::all_of(proof->views, [](const ProofView& view) {
      const QSize size(view.deltaE.size().width, view.deltaE.size().height);
      return view.wanted.size() == size && view.photograph.size() == size;
    });
    return areWhole ? proof : nullptr;
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
