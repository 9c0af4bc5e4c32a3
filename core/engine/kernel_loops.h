// SPDX-License-Identifier: MIT
// The inner loops of the engine in GCC's vector extensions. engine_kernels.cpp includes them once for each
// instruction set, in a namespace of its own, after it has defined
//   RELUCENT_KERNEL   what stands before a function of that set,
//   RELUCENT_LANES    floats in one of its registers: 4 or 8.
// All functions of a set are of that set: what GCC lowers for a lesser one before it inlines, stays so.

using Four [[gnu::vector_size(16)]] = float;
using Wide [[gnu::vector_size(4 * RELUCENT_LANES)]] = float;
using WideIntegers [[gnu::vector_size(4 * RELUCENT_LANES)]] = std::int32_t;
using WideCodes [[gnu::vector_size(2 * RELUCENT_LANES)]] = std::int16_t;

constexpr std::size_t lanes = RELUCENT_LANES;
constexpr std::size_t rowsOfAPart = lanes / 4;  // four lanes a row: three channels, and one that is free
constexpr std::size_t parts = rowsTogether / rowsOfAPart;

// A shuffle of the four lanes of every row, from two vectors as __builtin_shufflevector counts them.
constexpr int laneAt(int from, int row) {
  return from < 4 ? 4 * row + from : static_cast<int>(lanes) + 4 * row + from - 4;
}
#define RELUCENT_IN_ROW(row, i, j, k, l) laneAt(i, row), laneAt(j, row), laneAt(k, row), laneAt(l, row)
#if RELUCENT_LANES == 4
#define RELUCENT_SHUFFLED(a, b, i, j, k, l) __builtin_shufflevector(a, b, RELUCENT_IN_ROW(0, i, j, k, l))
#else
#define RELUCENT_SHUFFLED(a, b, i, j, k, l) \
  __builtin_shufflevector(a, b, RELUCENT_IN_ROW(0, i, j, k, l), RELUCENT_IN_ROW(1, i, j, k, l))
#endif

template <typename Values>
RELUCENT_KERNEL Values loaded(const void* from) {
  Values values;
  std::memcpy(&values, from, sizeof values);
  return values;
}

template <typename Values>
RELUCENT_KERNEL void store(void* to, const Values& values) {
  std::memcpy(to, &values, sizeof values);
}

RELUCENT_KERNEL Wide allLanes(float value) {
  return value - Wide{};
}

/// `lanes` codes.
RELUCENT_KERNEL Wide codesAt(const std::int16_t* code) {
#if RELUCENT_LANES == 4
  // In the upper half of 32 bits: fewer instructions than sign extension on the oldest processors.
  using Halves [[gnu::vector_size(16)]] = std::int16_t;
  using Longs [[gnu::vector_size(16)]] = std::int64_t;
  std::int64_t whole;
  std::memcpy(&whole, code, sizeof whole);
  const Halves halves = reinterpret_cast<Halves>(Longs{whole, 0});
  const Halves upper = __builtin_shufflevector(Halves{}, halves, 0, 8, 1, 9, 2, 10, 3, 11);
  return 0x1.0p-16f * __builtin_convertvector(reinterpret_cast<WideIntegers>(upper), Wide);
#else
  return __builtin_convertvector(__builtin_convertvector(loaded<WideCodes>(code), WideIntegers), Wide);
#endif
}

constexpr int greenChannel = 1;

/// Where the rows of a part find four floats: at `stride` times their place.
template <std::size_t stride, typename Place>
struct Places {
  const Place* place;
  RELUCENT_KERNEL std::size_t operator()(std::size_t row) const { return stride * std::size_t{place[row]}; }
};
struct Columns {
  const PackedLeaf* leaf;
  RELUCENT_KERNEL std::size_t operator()(std::size_t row) const {
    return columnFloats * std::size_t{leaf[row].column};
  }
};

template <typename Where>
RELUCENT_KERNEL Wide gathered(const float* base, const Where& at) {
#if RELUCENT_LANES == 4
  return loaded<Four>(base + at(0));
#else
  return __builtin_shufflevector(loaded<Four>(base + at(0)), loaded<Four>(base + at(1)), 0, 1, 2, 3, 4, 5, 6,
                                 7);
#endif
}

/// The four floats of one row of a part.
template <std::size_t row>
RELUCENT_KERNEL Four ofRow(const Wide& values) {
#if RELUCENT_LANES == 4
  return values;
#else
  constexpr int first = 4 * static_cast<int>(row);
  return __builtin_shufflevector(values, values, first, first + 1, first + 2, first + 3);
#endif
}

template <typename Where, std::size_t row = 0>
RELUCENT_KERNEL void addTo(float* base, const Where& at, const Wide& values) {
  float* to = base + at(row);
  store(to, loaded<Four>(to) + ofRow<row>(values));
  if constexpr (row + 1 < rowsOfAPart) addTo<Where, row + 1>(base, at, values);
}

/// The last rows first: where the first one is repeated, it is written last.
template <typename Where, std::size_t row = rowsOfAPart - 1>
RELUCENT_KERNEL void storeAt(float* base, const Where& at, const Wide& values) {
  store(base + at(row), ofRow<row>(values));
  if constexpr (row > 0) storeAt<Where, row - 1>(base, at, values);
}

/// A value for each row, in all of its lanes.
RELUCENT_KERNEL Wide eachRow(const float* value) {
#if RELUCENT_LANES == 4
  return allLanes(*value);
#else
  return Wide{value[0], value[0], value[0], value[0], value[1], value[1], value[1], value[1]};
#endif
}

/// Rows side by side.
struct Rows {
  Wide part[parts];
};

// Bytes ahead of which leaves are fetched. They are read in order, but no processor looks ahead far enough.
constexpr std::size_t leavesFetched = 2048;

/// What some rows of leaves see of their columns' light, before mixing.
RELUCENT_KERNEL void seenBy(const LeavesAbreast* leaves, std::size_t length, const float* light, Rows& seen) {
  for (std::size_t p = 0; p < parts; ++p) seen.part[p] = Wide{};
  for (std::size_t k = 0; k < length; ++k) {
    __builtin_prefetch(reinterpret_cast<const char*>(leaves + k) + leavesFetched);
    for (std::size_t p = 0; p < parts; ++p) {
      const PackedLeaf* leaf = &leaves[k].of[p * rowsOfAPart];
      seen.part[p] += codesAt(leaf->code.data()) * gathered(light, Columns{leaf});
    }
  }
}

/// Adds what they send back to their columns' sums, one row after the other: they may have columns in common.
/// `four`: green of a second light beside the three channels; otherwise `down` is 0 there.
template <bool four>
RELUCENT_KERNEL void sendBack(const LeavesAbreast* leaves, std::size_t length, const Rows& down,
                              float* sums) {
  for (std::size_t k = 0; k < length; ++k)
    for (std::size_t p = 0; p < parts; ++p) {
      const PackedLeaf* leaf = &leaves[k].of[p * rowsOfAPart];
      Wide codes = codesAt(leaf->code.data());
      if constexpr (four) codes = RELUCENT_SHUFFLED(codes, codes, 0, 1, 2, greenChannel);
      addTo(sums, Columns{leaf}, codes * down.part[p]);
    }
}

/// The mixings of a part's rows.
struct Mixings {
  Wide column[3];  // fourth lanes are 0
};

/// Without their scale.
RELUCENT_KERNEL Mixings mixingsAt(const PackedMixings& mixings, std::size_t part) {
  Mixings codes;
  for (std::size_t k = 0; k < 3; ++k) codes.column[k] = codesAt(mixings.code[k][part * rowsOfAPart].data());
  return codes;
}

RELUCENT_KERNEL Wide scalesAt(const PackedMixings& mixings, std::size_t part) {
  return eachRow(&mixings.scale[part * rowsOfAPart]);
}

RELUCENT_KERNEL Wide mixed(const Mixings& m, const Wide& light) {
  return RELUCENT_SHUFFLED(light, light, 0, 0, 0, 0) * m.column[0] +
         RELUCENT_SHUFFLED(light, light, 1, 1, 1, 1) * m.column[1] +
         RELUCENT_SHUFFLED(light, light, 2, 2, 2, 2) * m.column[2];
}

/// Rows of mixings as columns and the other way round; `third`: where the third one's values begin.
template <int third>
RELUCENT_KERNEL Mixings transposed(const Wide& a, const Wide& b, const Wide& c) {
  const Wide low = RELUCENT_SHUFFLED(a, b, 0, 4, 1, 5), high = RELUCENT_SHUFFLED(a, b, 2, 6, 3, 7);
  return {{RELUCENT_SHUFFLED(low, c, 0, 1, 4 + third, 4 + (third + 3) % 4),
           RELUCENT_SHUFFLED(low, c, 2, 3, 5 + third, 4 + (third + 3) % 4),
           RELUCENT_SHUFFLED(high, c, 0, 1, 6 + third, 4 + (third + 3) % 4)}};
}

/// Light on its way back: through the transposes. The fourth lanes are 0.
RELUCENT_KERNEL Wide unmixedBack(const Mixings& m, const Wide& light) {
  return mixed(transposed<0>(m.column[0], m.column[1], m.column[2]), light);
}

/// Green of that alone, in the fourth lanes; the others are 0.
RELUCENT_KERNEL Wide greenBack(const Mixings& m, const Wide& light) {
  const Wide each = m.column[greenChannel] * light;
  const Wide sum = RELUCENT_SHUFFLED(each, each, 0, 0, 0, 0) + RELUCENT_SHUFFLED(each, each, 1, 1, 1, 1) +
                   RELUCENT_SHUFFLED(each, each, 2, 2, 2, 2);
  return RELUCENT_SHUFFLED(Wide{}, sum, 0, 1, 2, 4);
}

/// What the groups of a square see with their parents, and the sums of what their rows send back. The first
/// place is that of rows without a group.
struct GroupLight {
  static constexpr std::size_t most = GroupSlice::nobody + 1;
  alignas(64) float seen[4 * most];
  alignas(64) float back[4 * most];
};
using GroupPlaces = Places<4, std::uint8_t>;

RELUCENT_KERNEL GroupPlaces placesOf(const GroupSlice::Each<std::uint8_t>& places, std::size_t part) {
  return {&places[part * rowsOfAPart]};
}

RELUCENT_KERNEL void lightGroups(const PatchRows& patch, const PackedSquare& square, const float* light,
                                 GroupLight& groups) {
  store(groups.seen, Four{});
  for (std::size_t i = square.groupSliceBegin; i < square.groupSliceEnd; ++i) {
    const GroupSlice& slice = patch.groupSlice[i];
    Rows seen;
    seenBy(patch.leaves + slice.leafBegin, slice.length, light, seen);
    for (std::size_t p = 0; p < parts; ++p)
      storeAt(groups.seen, placesOf(slice.place, p),
              eachRow(&slice.scale[p * rowsOfAPart]) * seen.part[p] +
                  gathered(groups.seen, placesOf(slice.parent, p)));
  }
}

/// Passes on what groups have got from their rows, the narrow ones first.
template <bool four>
RELUCENT_KERNEL void sendGroupsBack(const PatchRows& patch, const PackedSquare& square, GroupLight& groups,
                                    float* sums) {
  for (std::size_t i = square.groupSliceEnd; i-- > square.groupSliceBegin;) {
    const GroupSlice& slice = patch.groupSlice[i];
    Rows down;
    for (std::size_t p = 0; p < parts; ++p) {
      const Wide back = gathered(groups.back, placesOf(slice.place, p));
      addTo(groups.back, placesOf(slice.parent, p), back);
      down.part[p] = eachRow(&slice.scale[p * rowsOfAPart]) * back;
    }
    sendBack<four>(patch.leaves + slice.leafBegin, slice.length, down, sums);
  }
}

/// Through the leaves of rows and to their groups. `four`: with green of a second light, `lit`.
template <bool four>
RELUCENT_KERNEL void sendRowsBack(const PatchRows& patch, const RowSlice& slice, const Rows& light,
                                  const Rows& lit, GroupLight& groups, float* sums) {
  Rows down;
  for (std::size_t p = 0; p < parts; ++p) {
    const Mixings shared = mixingsAt(slice.shared, p), own = mixingsAt(slice.own, p);
    const Wide sharedScale = scalesAt(slice.shared, p), ownScale = scalesAt(slice.own, p);
    Wide toGroup = unmixedBack(shared, sharedScale * light.part[p]);
    down.part[p] = unmixedBack(own, ownScale * light.part[p]);
    if constexpr (four) {
      toGroup += greenBack(shared, sharedScale * lit.part[p]);
      down.part[p] += greenBack(own, ownScale * lit.part[p]);
    }
    addTo(groups.back, placesOf(slice.group, p), toGroup);
  }
  sendBack<four>(patch.leaves + slice.leafBegin, slice.length, down, sums);
}

// Slices ahead of which values of camera pixels are fetched: they lie in squares, which no processor
// foresees.
constexpr std::size_t fetchedAhead = 4;

template <typename Value>
RELUCENT_KERNEL void fetchAll(const Value* value) {
  for (std::size_t byte = 0; byte < sizeof *value; byte += 64)
    __builtin_prefetch(reinterpret_cast<const char*>(value) + byte);
}

template <bool correct>
RELUCENT_KERNEL void fetch(const PatchRows& patch, const CameraArrays& camera, std::size_t slice) {
  fetchAll(&patch.rowSlice[slice] + fetchedAhead);
  if constexpr (correct) fetchAll(&camera.unmix[slice]);
  for (const std::size_t pixel : patch.rowSlice[slice].pixel) {
    __builtin_prefetch(camera.wanted + 4 * pixel);
    if constexpr (correct) __builtin_prefetch(camera.unmixed + 4 * pixel, 1);
    if constexpr (correct) __builtin_prefetch(camera.lit + 4 * pixel);
  }
}

/// Of wanted light and weights, the weighted residuals.
RELUCENT_KERNEL void residualsOf(const PatchRows& patch, const RowSlice& slice, const GroupLight& groups,
                                 const float* light, Rows& rows) {
  Rows seen;
  seenBy(patch.leaves + slice.leafBegin, slice.length, light, seen);
  for (std::size_t p = 0; p < parts; ++p) {
    const Wide own = mixed(mixingsAt(slice.own, p), seen.part[p]);
    const Wide shared = mixed(mixingsAt(slice.shared, p), gathered(groups.seen, placesOf(slice.group, p)));
    const Wide wanted = rows.part[p];
    rows.part[p] = RELUCENT_SHUFFLED(wanted, wanted, 3, 3, 3, 3) *
                   (wanted - scalesAt(slice.own, p) * own - scalesAt(slice.shared, p) * shared);
  }
}

/// Light of camera pixels through their unmixing, which is read so that nothing behind it is. Fourth lanes
/// hold anything.
RELUCENT_KERNEL Wide unmixedOf(const float* unmix, const std::uint32_t* pixel, const Wide& light) {
  const Places<9, std::uint32_t> at{pixel};
  return mixed(transposed<1>(gathered(unmix, at), gathered(unmix + 3, at), gathered(unmix + 5, at)), light);
}

RELUCENT_KERNEL void unmix(const RowSlice& slice, const PackedMixings& mixings, const Rows& residual,
                           float* unmixed) {
  for (std::size_t p = parts; p-- > 0;)
    storeAt(unmixed, Places<4, std::uint32_t>{&slice.pixel[p * rowsOfAPart]},
            scalesAt(mixings, p) * mixed(mixingsAt(mixings, p), residual.part[p]));
}

/// Rows' wanted light and weights. Returns whether any of the weights is not 0.
RELUCENT_KERNEL bool wantedOf(const RowSlice& slice, const float* wanted, Rows& rows) {
  Wide weights{};
  for (std::size_t p = 0; p < parts; ++p) {
    rows.part[p] = gathered(wanted, Places<4, std::uint32_t>{&slice.pixel[p * rowsOfAPart]});
    weights += rows.part[p];
  }
  float sum = 0.0f;
  for (std::size_t row = 0; row < rowsOfAPart; ++row) sum += weights[4 * row + 3];
  return sum > 0.0f;
}

/// Weights residuals of the correction as the objective does, and lit light alike.
RELUCENT_KERNEL void weigh(const RowSlice& slice, const CameraArrays& camera, Rows& residual, Rows& lit) {
  for (std::size_t p = 0; p < parts; ++p) {
    const Places<4, std::uint32_t> at{&slice.pixel[p * rowsOfAPart]};
    const Wide unmixed = gathered(camera.unmixed, at), held = gathered(camera.wanted, at);
    const Wide sensitivity = RELUCENT_SHUFFLED(unmixed, unmixed, 3, 3, 3, 3);
    residual.part[p] *= sensitivity;
    lit.part[p] = sensitivity * RELUCENT_SHUFFLED(held, held, 3, 3, 3, 3) * gathered(camera.lit, at);
  }
}

template <bool correct>
RELUCENT_KERNEL void passOver(const PatchRows& patch, const CameraArrays& camera, float* columns) {
  const float* light = columns;
  float* sums = columns + 4;
  for (const PackedSquare& square : patch.squares) {
    GroupLight groups;
    lightGroups(patch, square, light, groups);
    std::memset(groups.back, 0, sizeof groups.back);
    // One slice behind: while one waits for its product, the former one's adjoint keeps the processor busy.
    const RowSlice* waiting = nullptr;
    Rows residual, lit;
    for (std::size_t i = square.rowSliceBegin; i < square.rowSliceEnd; ++i) {
      const RowSlice& slice = patch.rowSlice[i];
      if (i + fetchedAhead < patch.rowSlices) fetch<correct>(patch, camera, i + fetchedAhead);
      Rows rows, rowsLit;
      if (!wantedOf(slice, camera.wanted, rows)) {
        if constexpr (correct) unmix(slice, camera.unmix[i], Rows{}, camera.unmixed);
        continue;
      }
      residualsOf(patch, slice, groups, light, rows);
      if constexpr (correct) {
        const Rows unweighted = rows;
        weigh(slice, camera, rows, rowsLit);
        unmix(slice, camera.unmix[i], unweighted, camera.unmixed);
      }
      if (waiting != nullptr) sendRowsBack<correct>(patch, *waiting, residual, lit, groups, sums);
      waiting = &slice;
      residual = rows;
      if constexpr (correct) lit = rowsLit;
    }
    if (waiting != nullptr) sendRowsBack<correct>(patch, *waiting, residual, lit, groups, sums);
    sendGroupsBack<correct>(patch, square, groups, sums);
  }
}

/// In two steps, each of them one instruction; what is no number becomes 0.
RELUCENT_KERNEL Wide clamped(Wide values) {
  const Wide zero{}, one = allLanes(1.0f);
  values = values > zero ? values : zero;
  return values < one ? values : one;
}

RELUCENT_KERNEL Four sumOfRows(const Rows& rows) {
  Wide sum = rows.part[0];
  for (std::size_t p = 1; p < parts; ++p) sum += rows.part[p];
#if RELUCENT_LANES == 4
  return sum;
#else
  return ofRow<0>(sum) + ofRow<1>(sum);
#endif
}

/// The content's mean over one camera pixel.
RELUCENT_KERNEL Four meanOver(const WarpTiles::Footprint& at, const std::uint16_t* weights, const float* part,
                              std::size_t width) {
  using Codes [[gnu::vector_size(8)]] = std::uint16_t;
  using Integers [[gnu::vector_size(16)]] = std::int32_t;
  const std::uint16_t* weight = weights + WarpTiles::together * at.weight;
  const float* line = part + 4 * std::size_t{at.first};
  Rows sum{};
  for (std::size_t y = 0; y < at.lines; ++y, line += 4 * width)
    for (std::size_t x = 0; x < at.across; ++x, weight += WarpTiles::together) {
      const Four each =
          __builtin_convertvector(__builtin_convertvector(loaded<Codes>(weight), Integers), Four);
      const float* pixels = line + 16 * x;
#if RELUCENT_LANES == 4
      for (int p = 0; p < 4; ++p) sum.part[p] += each[p] * loaded<Wide>(pixels + 4 * p);
#else
      sum.part[0] += __builtin_shufflevector(each, each, 0, 0, 0, 0, 1, 1, 1, 1) * loaded<Wide>(pixels);
      sum.part[1] += __builtin_shufflevector(each, each, 2, 2, 2, 2, 3, 3, 3, 3) * loaded<Wide>(pixels + 8);
#endif
    }
  return at.scale * sumOfRows(sum);
}

struct Fitting {
  Mixings mixing;
  Wide offset, unreachable;
  Wide luminance;   // shares of the channels over white; where light counts alike, 0
  Wide sharedLoss;  // of what the worst channel loses, by the others: compensation::held()
  bool isHeld;      // no more is asked for than there is
  bool isLossShared;
};

/// Light of some camera pixels without what compensation::held() takes from all of its channels, before each
/// is clamped.
RELUCENT_KERNEL Wide withSharedLoss(const Wide& light, const Wide& most, const Fitting& fitting) {
  const Wide one = allLanes(1.0f), kept = light > most ? most / light : one;
  const Wide second = RELUCENT_SHUFFLED(kept, kept, 1, 2, 0, 3),
             third = RELUCENT_SHUFFLED(kept, kept, 2, 0, 1, 3);
  const Wide less = second < third ? second : third, least = kept < less ? kept : less;
  return (one - fitting.sharedLoss * (one - least)) * light;
}

/// Makes of content what is wanted of some camera pixels, and what the windows are given.
RELUCENT_KERNEL void fit(const std::uint32_t* pixel, const Wide& content, const Fitting& fitting,
                         const ContentTarget& target) {
  const Places<8, std::uint32_t> known{pixel};
  const Wide black = gathered(target.known, known), flood = gathered(target.known + 4, known);
  const Wide gain = RELUCENT_SHUFFLED(flood, flood, 3, 3, 3, 3);
  const Wide value = gain * (fitting.offset + mixed(fitting.mixing, content)), wanted = value - black;
  const WideIntegers within = (value >= black) & (value <= black + flood);
  const WideIntegers reachable =
      within & RELUCENT_SHUFFLED(within, within, 1, 2, 0, 3) & RELUCENT_SHUFFLED(within, within, 2, 0, 1, 3);
  const Wide zero{}, view = RELUCENT_SHUFFLED(black, black, 3, 3, 3, 3), one = allLanes(1.0f);
  const Wide share = reachable ? one : fitting.unreachable, ofWindows = view * share;
  const Wide most = flood > zero ? flood : zero, lit = wanted > zero ? wanted : zero;
  const Wide positive = fitting.isLossShared ? withSharedLoss(lit, most, fitting) : lit;
  const Wide held = positive < most ? positive : most;
  const Wide lights = fitting.luminance * (held + black);
  const Wide luminance = RELUCENT_SHUFFLED(lights, lights, 0, 0, 0, 0) +
                         RELUCENT_SHUFFLED(lights, lights, 1, 1, 1, 1) +
                         RELUCENT_SHUFFLED(lights, lights, 2, 2, 2, 2);
  const Wide offset = allLanes(compensation::sensitivityOffset);
  const Wide sensitivity =
      fitting.isHeld ? (one + offset) / ((luminance < one ? luminance : one) + offset) : one;
  const Places<4, std::uint32_t> at{pixel};
  storeAt(target.wanted, at,
          RELUCENT_SHUFFLED(fitting.isHeld ? held : wanted, sensitivity * ofWindows, 0, 1, 2, 4));
  storeAt(target.held, at, RELUCENT_SHUFFLED(held, ofWindows, 0, 1, 2, 4));
  const Wide unmixed = unmixedOf(target.unmix, pixel, held);
  storeAt(target.unmixed, at, RELUCENT_SHUFFLED(unmixed, sensitivity, 0, 1, 2, 4));
  if (target.placed != nullptr) storeAt(target.placed, at, content);
}

RELUCENT_KERNEL void placeTile(const WarpTiles& warp, const WarpTiles::Tile& tile, const float* part,
                               const ContentTarget& target) {
  Fitting fitting{{},
                  allLanes(target.offset),
                  allLanes(target.unreachable),
                  {},
                  allLanes(target.sharedLoss),
                  target.perWhite > 0.0f,
                  target.sharedLoss > 0.0f};
  alignas(64) float luminance[lanes];
  for (std::size_t i = 0; i < lanes; ++i)
    luminance[i] = i % 4 < 3 ? target.perWhite * image::luminanceWeights[i % 4] : 0.0f;
  fitting.luminance = loaded<Wide>(luminance);
  for (std::size_t k = 0; k < 3; ++k) {
    alignas(64) float column[lanes];
    for (std::size_t i = 0; i < lanes; ++i) column[i] = i % 4 < 3 ? target.mixing[3 * (i % 4) + k] : 0.0f;
    fitting.mixing.column[k] = loaded<Wide>(column);
  }
  for (std::size_t first = tile.begin; first < tile.end; first += rowsTogether) {
    alignas(64) float mean[4 * rowsTogether];
    std::uint32_t pixel[rowsTogether];
    for (std::size_t i = 0; i < rowsTogether; ++i) {
      const WarpTiles::Footprint& footprint = warp.footprints[first + i];
      pixel[i] = footprint.pixel;
      store(mean + 4 * i, meanOver(footprint, warp.weights.data(), part, tile.width));
    }
    for (std::size_t p = 0; p < parts; ++p)
      fit(pixel + p * rowsOfAPart, loaded<Wide>(mean + lanes * p), fitting, target);
  }
}

/// The values of `lanes` pixels, one channel after the other, as pixels of three.
RELUCENT_KERNEL void storePixels(float* to, const Wide& red, const Wide& green, const Wide& blue) {
#if RELUCENT_LANES == 4
  store(to, __builtin_shufflevector(__builtin_shufflevector(red, green, 0, 4, 1, 5), blue, 0, 1, 4, 2));
  const Wide middle = __builtin_shufflevector(red, green, 5, 2, 6, 3);
  store(to + 4, __builtin_shufflevector(middle, blue, 0, 5, 1, 2));
  store(to + 8, __builtin_shufflevector(__builtin_shufflevector(red, green, 3, 7, 3, 7), blue, 6, 0, 1, 7));
#else
  const Wide first = __builtin_shufflevector(red, green, 0, 8, 0, 1, 9, 1, 2, 10);
  store(to, __builtin_shufflevector(first, blue, 0, 1, 8, 3, 4, 9, 6, 7));
  const Wide second = __builtin_shufflevector(red, green, 2, 3, 11, 3, 4, 12, 4, 5);
  store(to + 8, __builtin_shufflevector(second, blue, 10, 1, 2, 11, 4, 5, 12, 7));
  const Wide third = __builtin_shufflevector(red, green, 13, 5, 6, 14, 6, 7, 15, 7);
  store(to + 16, __builtin_shufflevector(third, blue, 0, 13, 2, 3, 14, 5, 6, 15));
#endif
}

RELUCENT_KERNEL void windowOf(const inverse::WindowArrays& windows, std::size_t tile, const float* unmixed,
                              bool clamp, float* values) {
  constexpr std::size_t together = 16, vectors = together / lanes;  // pixels: sums that stay in registers
  const auto pixels = static_cast<std::size_t>(windows.tile * windows.tile);
  const std::size_t begin = windows.start[tile], end = windows.start[tile + 1];
  const float* scale = windows.scale + 3 * tile;
  for (std::size_t part = 0; part < pixels; part += together) {
    Wide sum[3][vectors] = {};
    const std::int16_t* code = windows.weight + 3 * pixels * begin + part;
    for (std::size_t k = begin; k < end; ++k, code += 3 * pixels) {
      const float* in = unmixed + 4 * std::size_t{windows.row[k]};
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t v = 0; v < vectors; ++v) sum[c][v] += in[c] * codesAt(code + c * pixels + v * lanes);
    }
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t v = 0; v < vectors; ++v) {
        sum[c][v] *= scale[c];
        if (clamp) sum[c][v] = clamped(sum[c][v]);
      }
    for (std::size_t v = 0; v < vectors; ++v)
      storePixels(values + 3 * (part + v * lanes), sum[0][v], sum[1][v], sum[2][v]);
  }
}

/// Twelve values of four pixels, three a pixel.
struct Pixels {
  Four part[3];
};

/// Of four floats a pixel, the first three.
RELUCENT_KERNEL Pixels channelsOf(const float* values) {
  const Four a = loaded<Four>(values), b = loaded<Four>(values + 4), c = loaded<Four>(values + 8),
             d = loaded<Four>(values + 12);
  return {{__builtin_shufflevector(a, b, 0, 1, 2, 4), __builtin_shufflevector(b, c, 1, 2, 4, 5),
           __builtin_shufflevector(c, d, 2, 4, 5, 6)}};
}

/// One value a pixel, for all of its channels.
RELUCENT_KERNEL Pixels forChannels(const Four& value) {
  return {{__builtin_shufflevector(value, value, 0, 0, 0, 1),
           __builtin_shufflevector(value, value, 1, 1, 2, 2),
           __builtin_shufflevector(value, value, 2, 3, 3, 3)}};
}

using FourIntegers [[gnu::vector_size(16)]] = std::int32_t;

constexpr std::size_t pixelsTogether = 4;

/// Values of an update in place; `cut` counts down where a value is visibly cut off.
RELUCENT_KERNEL void updateSome(float* p, const float* c, const float* back, float length,
                                FourIntegers& cut) {
  const Pixels step = channelsOf(back);
  const Four zero{}, one = 1.0f - zero, below = -visibleCut - zero, above = (1.0f + visibleCut) - zero;
  for (std::size_t i = 0; i < 3; ++i) {
    Four value = loaded<Four>(p + 4 * i);
    value += length * loaded<Four>(c + 4 * i) * step.part[i];
    cut += (value < below) | (value > above);
    value = value > zero ? value : zero;
    store(p + 4 * i, value < one ? value : one);
  }
}

RELUCENT_KERNEL std::size_t updateAll(float* p, const float* c, const float* back, float length,
                                      std::size_t pixels) {
  FourIntegers cut{};
  std::size_t i = 0;
  for (; i + pixelsTogether <= pixels; i += pixelsTogether)
    updateSome(p + 3 * i, c + 3 * i, back + sumFloats * i, length, cut);
  if (i < pixels) {
    float values[3 * pixelsTogether] = {}, steps[3 * pixelsTogether] = {},
                     sums[sumFloats * pixelsTogether] = {};
    std::copy_n(p + 3 * i, 3 * (pixels - i), values);
    std::copy_n(c + 3 * i, 3 * (pixels - i), steps);
    std::copy_n(back + sumFloats * i, sumFloats * (pixels - i), sums);
    updateSome(values, steps, sums, length, cut);
    std::copy_n(values, 3 * (pixels - i), p + 3 * i);
  }
  std::int32_t all = 0;
  for (std::size_t lane = 0; lane < 4; ++lane) all -= cut[lane];
  return static_cast<std::size_t>(all);
}

/// Of four pixels; see StepPreconditioner::from().
RELUCENT_KERNEL void preconditionSome(float* c, const float* back, const float* share, const float* least) {
  const Four low = __builtin_shufflevector(loaded<Four>(back), loaded<Four>(back + 4), 3, 7, 3, 7);
  const Four high = __builtin_shufflevector(loaded<Four>(back + 8), loaded<Four>(back + 12), 3, 7, 3, 7);
  const Four bound = __builtin_shufflevector(low, high, 0, 1, 4, 5), limit = loaded<Four>(least), zero{};
  const Four unseen = compensation::StepPreconditioner::nextToNothing - zero;
  const Four unless = limit <= std::numeric_limits<float>::max() - zero ? unseen : zero;
  const Pixels inverse = forChannels(bound > limit ? 1.0f / bound : unless);
  for (std::size_t i = 0; i < 3; ++i) {
    const Four of = loaded<Four>(share + 4 * i);
    store(c + 4 * i, of >= zero ? of * inverse.part[i] : inverse.part[i] > zero ? -of : zero);
  }
}

RELUCENT_KERNEL void preconditionAll(float* c, const float* back, const float* share, const float* least,
                                     std::size_t pixels) {
  std::size_t i = 0;
  for (; i + pixelsTogether <= pixels; i += pixelsTogether)
    preconditionSome(c + 3 * i, back + sumFloats * i, share + 3 * i, least + i);
  for (; i < pixels; ++i) {
    const float inverse = least[i] <= std::numeric_limits<float>::max()
                              ? compensation::StepPreconditioner::inverse(back[sumFloats * i + 3], least[i])
                              : 0.0f;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      c[k] = compensation::StepPreconditioner::from(share[k], inverse);
  }
}

#undef RELUCENT_IN_ROW
#undef RELUCENT_SHUFFLED

RELUCENT_FUNCTION void place(const WarpTiles& warp, const WarpTiles::Tile& tile, const float* part,
                             const ContentTarget& target) {
  placeTile(warp, tile, part, target);
}

RELUCENT_FUNCTION void window(const inverse::WindowArrays& windows, std::size_t tile, const float* unmixed,
                              bool clamp, float* values) {
  windowOf(windows, tile, unmixed, clamp, values);
}

RELUCENT_FUNCTION void step(const PatchRows& patch, const CameraArrays& camera, float* columns) {
  passOver<false>(patch, camera, columns);
}

RELUCENT_FUNCTION void correct(const PatchRows& patch, const CameraArrays& camera, float* columns) {
  passOver<true>(patch, camera, columns);
}

RELUCENT_FUNCTION std::size_t update(float* p, const float* c, const float* back, float length,
                                     std::size_t pixels) {
  return updateAll(p, c, back, length, pixels);
}

RELUCENT_FUNCTION void precondition(float* c, const float* back, const float* share, const float* least,
                                    std::size_t pixels) {
  preconditionAll(c, back, share, least, pixels);
}

constexpr EngineKernels kernelsFor(const char* instructions) {
  return {instructions, place, window, step, correct, update, precondition};
}
