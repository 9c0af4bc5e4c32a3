// SPDX-License-Identifier: MIT
#include "relucent/engine/opengl/opengl_backend.h"

#include <algorithm>
#include <bit>

#include "relucent/base/error.h"
#include "relucent/engine/opengl/backend_objects.h"
#include "relucent/engine/opengl/gl_context.h"
#include "relucent/image/colour.h"

namespace relucent::engine {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t vector = 4 * sizeof(float);

/// Tiles as their shader reads them: the first row of the window and the scales of its weights.
std::vector<std::array<std::uint32_t, 4>> tilesOf(const inverse::WindowArrays& windows) {
  std::size_t count = windows.tiles->count();
  std::vector<std::array<std::uint32_t, 4>> tiles(count + 1);
  for (std::size_t tile = 0; tile <= count; ++tile) {
    tiles[tile][0] = static_cast<std::uint32_t>(windows.start[tile]);
    for (std::size_t c = 0; c < 3 && tile < count; ++c)
      tiles[tile][c + 1] = std::bit_cast<std::uint32_t>(windows.scale[3 * tile + c]);
  }
  return tiles;
}

/// What does not change with the content; it has room for what does.
std::vector<float> knownOf(const compensation::MeasuredVenue& venue, const inverse::WindowArrays& windows) {
  std::vector<float> known(knownFloats * venue.usable.size());
  for (std::size_t i = 0; i < venue.usable.size(); ++i) {
    float* to = &known[knownFloats * i];
    std::copy_n(&venue.black[3 * i], 3, to);
    std::copy_n(&venue.flood[3 * i], 3, to + 4);
    std::copy_n(windows.unmix + 9 * i, 9, to + 12);
  }
  const Rasters& cameras = venue.transport.cameras();
  for (std::size_t view = 0; view < cameras.devices(); ++view)
    for (std::size_t i = cameras.offset(view); i < cameras.offset(view) + cameras.size(view).count(); ++i)
      known[knownFloats * i + 7] = static_cast<float>(view);
  return known;
}

std::vector<std::uint32_t> wordsOf(std::span<const std::uint16_t> levels) {
  return {levels.begin(), levels.end()};
}

GlBuffer bufferOf(std::span<const float> values) {
  return GlBuffer(values.size_bytes(), values.data());
}

/// The ranges of tiles whose weights a shader can reach at once.
template <typename Batch>
std::vector<Batch> batchesOf(const inverse::WindowArrays& windows, std::size_t most) {
  const std::size_t bytesOfARow = 6 * static_cast<std::size_t>(windows.tile * windows.tile);
  const std::size_t alignment = GlBuffer::alignment();
  std::vector<Batch> batches;
  for (std::size_t projector = 0; projector < windows.tiles->devices(); ++projector) {
    std::size_t tile = windows.tiles->offset(projector);
    const std::size_t last = tile + windows.tiles->size(projector).count();
    while (tile < last) {
      const std::size_t begin = bytesOfARow * windows.start[tile] / alignment * alignment;
      std::size_t end = tile + 1;
      while (end < last && bytesOfARow * windows.start[end + 1] - begin <= most) ++end;
      // One byte at the least: windows may be empty.
      const std::size_t bytes = std::max<std::size_t>(bytesOfARow * windows.start[end] - begin, 4);
      batches.push_back({tile, end - tile, {begin, bytes}, projector});
      tile = end;
    }
  }
  return batches;
}

/// Camera pixels begin a part at multiples of so many, and slices of them: what they are known by and their
/// rows are then aligned to 256 bytes, the most that OpenGL may ask for.
constexpr std::size_t pixelsOfAPart = 8, slicesOfAPart = 8;
static_assert(pixelsOfAPart * bytesKnown % 256 == 0 &&
              slicesOfAPart * LeafSlices::lanes * sizeof(SlicedTransport::Row) % 256 == 0);

/// The ranges of camera pixels of which a shader can reach at once what they are known by.
template <typename Batch>
std::vector<Batch> batchesOf(std::size_t pixels, std::size_t most) {
  const std::size_t atOnce = std::max(most / bytesKnown / pixelsOfAPart, std::size_t{1}) * pixelsOfAPart;
  std::vector<Batch> batches;
  for (std::size_t first = 0; first < pixels; first += atOnce) {
    const std::size_t count = std::min(atOnce, pixels - first);
    batches.push_back({first, count, {bytesKnown * first, bytesKnown * count}});
  }
  return batches;
}

/// The camera pixels of some slices.
struct PixelRange {
  std::size_t first = std::numeric_limits<std::size_t>::max(), end = 0;

  PixelRange with(const PixelRange& other) const {
    return {std::min(first, other.first), std::max(end, other.end)};
  }
  std::size_t bytes() const { return end > first ? bytesKnown * (end - first) : 0; }
};

PixelRange pixelsOf(const std::vector<SlicedTransport::Row>& rows, std::size_t firstSlice,
                    std::size_t endSlice) {
  PixelRange range;
  for (std::size_t i = LeafSlices::lanes * firstSlice; i < LeafSlices::lanes * endSlice && i < rows.size();
       ++i)
    if (rows[i].pixel != SlicedTransport::none)
      range = range.with({rows[i].pixel / pixelsOfAPart * pixelsOfAPart, std::size_t{rows[i].pixel} + 1});
  return range;
}

}  // namespace

OpenGlBackend::Objects::Slices::Slices(const LeafSlices& from, const std::vector<SlicedTransport::Row>& rows,
                                       std::size_t most)
    : slices(from.slices), leaves(from.leaves, true) {
  constexpr std::size_t bytesOfAUnit = LeafSlices::lanes * sizeof(PackedLeaf),
                        rowsOfASlice = LeafSlices::lanes * sizeof(SlicedTransport::Row);
  const std::size_t step = rows.empty() ? 1 : slicesOfAPart;
  for (std::size_t first = 0; first < from.count();) {
    const auto bytesUpTo = [&](std::size_t end) {
      return bytesOfAUnit * (from.slices[end].leaf - from.slices[first].leaf);
    };
    std::size_t end = std::min(first + step, from.count());
    PixelRange pixels = pixelsOf(rows, first, end);
    while (end < from.count()) {
      const std::size_t next = std::min(end + step, from.count());
      const PixelRange more = pixels.with(pixelsOf(rows, end, next));
      if (bytesUpTo(next) > most || (!rows.empty() && rowsOfASlice * (next - first) > most) ||
          more.bytes() > most)
        break;
      end = next;
      pixels = more;
    }
    Batch batch{
        first, end - first, {bytesOfAUnit * from.slices[first].leaf, std::max(bytesUpTo(end), bytesOfAUnit)}};
    batch.rows = {rowsOfASlice * first, rowsOfASlice * (end - first)};
    batch.camera = {pixels.bytes() > 0 ? bytesKnown * pixels.first : 0, std::max(pixels.bytes(), bytesKnown)};
    batches.push_back(batch);
    first = end;
  }
}

OpenGlBackend::Objects::Objects(const EngineVenue& engine_, std::size_t mostBound) : engine(engine_) {
  const std::size_t most = std::min(mostBound, GlBuffer::largest());
  const inverse::WindowArrays arrays = engine.inverse.view();
  const std::size_t pixels = static_cast<std::size_t>(arrays.tile * arrays.tile);
  const std::size_t windowCount = arrays.start[arrays.tiles->count()];
  tiles = GlBuffer(tilesOf(arrays));
  windowRows = GlBuffer(windowCount * sizeof(std::uint32_t), arrays.row);
  windowWeights = GlBuffer(3 * pixels * windowCount * sizeof(std::int16_t), arrays.weight, true);
  tileBatches = batchesOf<Batch>(arrays, most);

  nodeCount = engine.venue.transport.layout().count();
  const SlicedTransport sliced = slicedTransport(engine.transport, nodeCount);
  forward = Slices(sliced.forward, sliced.rows, most);
  groupForward = Slices(sliced.groupForward, most);
  backward = Slices(sliced.backward, most);
  rows = GlBuffer(sliced.rows, true);
  groups = GlBuffer(sliced.groups);
  groupBack = GlBuffer(sliced.groupBack);
  groupSlots = sliced.groups.size();
  nodes = GlBuffer(engine.transport.nodes());
  nodeStart = GlBuffer(sliced.nodeStart);
  segments = GlBuffer(sliced.segments);
  longNodes = GlBuffer(sliced.longNodes);
  columns = engine.transport.nodes().size();
  longCount = sliced.longNodes.size();

  cameraPixels = engine.venue.usable.size();
  known = knownOf(engine.venue, arrays);
  camera = GlBuffer(known, true);
  cameraBatches = batchesOf<Batch>(cameraPixels, most);
  wanted = GlBuffer(vector * cameraPixels);
  unmixed = GlBuffer(vector * cameraPixels);
  placed = GlBuffer(vector * cameraPixels);
  projectorPixels = engine.brightest.size();
  light = GlBuffer(vector * projectorPixels);
  nodeLight = GlBuffer(2 * sizeof(std::uint32_t) * nodeCount);
  columnLight = GlBuffer(2 * sizeof(std::uint32_t) * (columns + groupSlots));
  groupLight = GlBuffer(vector * groupSlots);
  back = GlBuffer(vector * sliced.backPlaces);
  segmentSums = GlBuffer(vector * LeafSlices::lanes * sliced.backward.count());
  sums = GlBuffer(vector * (nodeCount + projectorPixels));
  std::vector<float> steps(4 * projectorPixels);
  for (std::size_t j = 0; j < projectorPixels; ++j)
    std::copy_n(&engine.preconditioner.share()[3 * j], 3, &steps[4 * j]);
  sums.write(vector * nodeCount, steps.data(), steps.size() * sizeof(float));
  counters = GlBuffer(vector);
  brightnessParts = GlBuffer(65 * 2 * sizeof(float));
  brightest = GlBuffer(engine.brightest);
  kept = GlBuffer(sizeof(float) * projectorPixels);
  words = GlBuffer(sizeof(std::uint32_t) * projectorPixels);

  std::vector<float> linear;
  for (int code = 0; code < 256; ++code)
    linear.push_back(static_cast<float>(image::srgbDecode(code / 255.0)));
  linear.resize(linear.size() + field.octaves.size());  // even
  linearOfSrgb = GlBuffer(linear);
  for (const DriveEncoder& encoder : engine.encoders)
    encoders.push_back({GlBuffer(wordsOf(encoder.firstLevels())), bufferOf(encoder.lights()),
                        bufferOf(encoder.middles()), bufferOf(encoder.thresholds())});
}

void OpenGlBackend::Objects::setContent(const EngineContent& next) {
  const ContentWarp& warp = next.warp;
  // Lines of any format begin at whole words.
  const Size size = warp.content();
  frame = {};
  footprints = {};
  weights = {};
  frame = GlBuffer(bytesPerPixel(ContentFrame::Format::linearFloat) * size.count() + 4 * size.count());
  static_assert(sizeof(ContentWarp::Footprint) == 20);
  footprints = GlBuffer(warp.footprints());
  weights = GlBuffer(warp.weights());
  for (std::size_t i = 0; i < cameraPixels; ++i) {
    float* const to = &known[knownFloats * i];
    to[3] = compensation::relianceOn(engine.venue, i) * next.unmaskedShare(i);
    to[11] = next.unmaskedShare(i);
    std::copy_n(next.place[i].data(), 2, to + 21);
  }
  kept.write(0, next.kept.empty() ? std::vector<float>(projectorPixels, 1.0f).data() : next.kept.data(),
             projectorPixels * sizeof(float));
  content = &next;
  hasLast = false;
  takeFree({});
  takeWeights();
  for (GlBuffer* buffer : {&wanted, &unmixed, &placed, &nodeLight}) buffer->clear();
}

void OpenGlBackend::Objects::takeWeights() noexcept {
  for (const GlProgram* program : {&placing, &brightness}) program->setFloats(16, content->viewWeight);
}

void OpenGlBackend::Objects::takeFree(std::span<const float> last) {
  freeVersion = content->freeVersion;
  const CameraStack& flood = engine.venue.flood;
  const bool all = content->available.empty();
  for (std::size_t i = 0; i < 3 * cameraPixels; ++i) {
    const float missing = all ? 0.0f : content->missing[i];
    float* const to = &known[knownFloats * (i / 3) + i % 3];
    to[4] = all ? flood[i] : std::max(0.0f, flood[i] - missing);
    to[8] = all ? content->lit[i] : std::max(0.0f, content->lit[i] - missing);
  }
  brightest.write(0, content->brightest.data(), sizeof(std::int32_t) * projectorPixels);
  camera.write(0, known.data(), known.size() * sizeof(float));
  takeLight(last);
  freeValues = 3 * static_cast<std::size_t>(std::count(content->free.begin(), content->free.end(), 1));
}

std::vector<float> OpenGlBackend::Objects::lastLight() {
  std::vector<float> four(4 * projectorPixels), three(3 * projectorPixels);
  light.read(0, four.data(), four.size() * sizeof(float));
  for (std::size_t j = 0; j < projectorPixels; ++j) std::copy_n(&four[4 * j], 3, &three[3 * j]);
  return three;
}

void OpenGlBackend::Objects::takeLight(std::span<const float> last) {
  std::vector<float> values(4 * projectorPixels);
  for (std::size_t j = 0; j < projectorPixels; ++j) {
    const float share = content->available.empty() ? 1.0f : content->available[j];
    for (std::size_t c = 0; c < 3 && !last.empty(); ++c) values[4 * j + c] = std::min(last[3 * j + c], share);
    values[4 * j + 3] = content->free[j] ? share : 0.0f;
  }
  light.write(0, values.data(), values.size() * sizeof(float));
}

OpenGlBackend::OpenGlBackend(const EngineVenue& engine, std::unique_ptr<GlContext> context,
                             std::size_t mostBound)
    : context_(std::move(context)), name_(fmt::format("OpenGL, {}", context_->renderer())) {
  GlContext::Current current(*context_);
  if (!current)
    throw Error(ErrorKind::device,
                RELUCENT_MESSAGE("engine.graphics-card-unusable", "the graphics card cannot be used"),
                RELUCENT_MESSAGE("engine.compute-on-processor", "compute on the processor instead"),
                context_->renderer());
  objects_ = std::make_unique<Objects>(engine, mostBound);
}

OpenGlBackend::~OpenGlBackend() {
  GlContext::Current current(*context_);
  objects_.reset();
}

void OpenGlBackend::setContent(const EngineContent& content) {
  GlContext::Current current(*context_);
  if (current && !lost_) {
    objects_->setContent(content);
    if (!context_->failed()) return;
  }
  throwLost();
}

void OpenGlBackend::throwLost() const {
  throw Error(ErrorKind::device, RELUCENT_MESSAGE("engine.graphics-card-lost", "the graphics card was lost"),
              RELUCENT_MESSAGE("engine.compute-on-processor", "compute on the processor instead"), name_);
}

void OpenGlBackend::contentFollowed() {
  require(objects_->content != nullptr, "content that follows was not set");
  GlContext::Current current(*context_);
  if (current && !lost_) {
    objects_->takeWeights();
    if (objects_->content->freeVersion != objects_->freeVersion) objects_->takeFree(objects_->lastLight());
    if (!context_->failed()) return;
  }
  throwLost();
}

void OpenGlBackend::availabilityFollowed() {
  require(objects_->content != nullptr, "content whose light arrives was not set");
  GlContext::Current current(*context_);
  if (current && !lost_) {
    objects_->takeFree(objects_->lastLight());
    if (!context_->failed()) return;
  }
  throwLost();
}

void OpenGlBackend::startFrom(std::span<const float> projector) {
  require(objects_->content != nullptr && projector.size() == 3 * objects_->projectorPixels,
          "{} values of {} projector pixels", projector.size(), objects_->projectorPixels);
  GlContext::Current current(*context_);
  if (current && !lost_) {
    std::vector<float> dimmed(projector.begin(), projector.end());
    for (std::size_t i = 0; i < dimmed.size(); ++i)
      dimmed[i] = objects_->content->availableOf(i / 3, dimmed[i]);
    objects_->takeLight(dimmed);
    objects_->hasLast = true;
    if (!context_->failed()) return;
  }
  throwLost();
}

template <typename Deliver>
bool OpenGlBackend::renderTo(const ContentFrame& frame, const FrameRequest& request, const Deliver& deliver,
                             FrameReport& report) noexcept {
  report = {};
  const Clock::time_point begin = Clock::now();
  GlContext::Current current(*context_);
  if (!current || lost_) return false;
  const std::size_t lengths = objects_->engine.settings.compensator.steps.size();
  if (request.compensated) report.steps = std::clamp(request.steps, 0, static_cast<int>(lengths));
  objects_->render(frame, request, report.steps);

  deliver();
  std::uint32_t clipped = 0;
  // Waits for all that was asked for before.
  objects_->counters.read(0, &clipped, sizeof clipped);
  if (context_->failed()) return false;
  if (request.compensated)
    report.stepSeconds =
        std::chrono::duration<double>(objects_->refined.seconds() - objects_->refining.seconds());
  if (objects_->freeValues > 0)
    report.clipped = static_cast<double>(clipped) / static_cast<double>(objects_->freeValues);
  report.seconds = Clock::now() - begin;
  return true;
}

bool OpenGlBackend::render(const ContentFrame& frame, const FrameRequest& request,
                           std::span<std::uint32_t> words, FrameReport& report) noexcept {
  return renderTo(frame, request, [&] { objects_->words.read(0, words.data(), words.size_bytes()); }, report);
}

bool OpenGlBackend::sharesTextures() const {
  return context_->isShared();
}

bool OpenGlBackend::renderToTextures(const ContentFrame& frame, const FrameRequest& request,
                                     std::span<const std::uint32_t> textures, FrameReport& report) noexcept {
  return renderTo(
      frame, request,
      [&] {
        const Rasters& projectors = objects_->engine.venue.transport.projectors();
        for (std::size_t projector = 0; projector < textures.size(); ++projector)
          objects_->words.copyToTexture(textures[projector], projectors.size(projector),
                                        sizeof(std::uint32_t) * projectors.offset(projector));
        glFinish();
      },
      report);
}

}  // namespace relucent::engine
