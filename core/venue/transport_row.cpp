// SPDX-License-Identifier: MIT
#include "relucent/venue/transport_row.h"

#include <algorithm>
#include <tuple>

namespace relucent::venue {
namespace {

bool sameParent(const transport::Node& a, const transport::Node& b) {
  return a.level == b.level && a.projector == b.projector && a.x / 2 == b.x / 2 && a.y / 2 == b.y / 2;
}

auto familyKey(const transport::Node& node) {
  return std::tuple(node.level, node.projector, node.y / 2, node.x / 2, node.y, node.x);
}

}  // namespace

TransportRow::TransportRow() : slots_(1024, 0) {}

void TransportRow::clear() {
  entries_.clear();
  std::fill(slots_.begin(), slots_.end(), 0u);
}

std::size_t TransportRow::slotOf(const transport::Node& node) const {
  std::uint32_t h = static_cast<std::uint32_t>(node.x) * 0x9e3779b1u ^
                    static_cast<std::uint32_t>(node.y) * 0x85ebca77u ^
                    static_cast<std::uint32_t>(node.level * 16 + node.projector) * 0xc2b2ae3du;
  h ^= h >> 15;
  std::size_t mask = slots_.size() - 1;
  std::size_t slot = h & mask;
  while (slots_[slot] != 0 && !(entries_[slots_[slot] - 1].node == node)) slot = (slot + 1) & mask;
  return slot;
}

void TransportRow::grow() {
  slots_.assign(2 * slots_.size(), 0);
  for (std::size_t i = 0; i < entries_.size(); ++i)
    slots_[slotOf(entries_[i].node)] = static_cast<std::uint32_t>(i + 1);
}

void TransportRow::add(const transport::Node& node, const Spectrum& transport) {
  if (2 * entries_.size() >= slots_.size()) grow();
  std::uint32_t& slot = slots_[slotOf(node)];
  if (slot == 0) {
    entries_.push_back({node, transport});
    slot = static_cast<std::uint32_t>(entries_.size());
  } else {
    entries_[slot - 1].transport += transport;
  }
}

void TransportRow::condense(float share, int finest, int coarsest) {
  float total = 0.0f;
  for (const Entry& entry : entries_) total += entry.transport.sum();
  float least = share * total;

  std::vector<Entry> kept, level;
  for (const Entry& entry : entries_)
    if (entry.node.level < finest) kept.push_back(entry);
  std::vector<Entry> risen;
  for (int height = finest; height <= coarsest; ++height) {
    level.swap(risen);
    risen.clear();
    for (const Entry& entry : entries_)
      if (entry.node.level == height) level.push_back(entry);
    std::stable_sort(level.begin(), level.end(),
                     [](const Entry& a, const Entry& b) { return familyKey(a.node) < familyKey(b.node); });
    for (std::size_t begin = 0, end = 0; begin < level.size(); begin = end) {
      Spectrum sum = Spectrum::Zero();
      while (end < level.size() && sameParent(level[begin].node, level[end].node))
        sum += level[end++].transport;
      if (height < coarsest && sum.sum() < least) {
        const transport::Node& node = level[begin].node;
        risen.push_back({{node.projector, node.level + 1, node.x / 2, node.y / 2}, sum});
      } else {
        kept.insert(kept.end(), level.begin() + static_cast<std::ptrdiff_t>(begin),
                    level.begin() + static_cast<std::ptrdiff_t>(end));
      }
    }
    level.clear();
  }
  // A risen node may meet one that was there: add() joins them.
  clear();
  for (const Entry& entry : kept) add(entry.node, entry.transport);
}

}  // namespace relucent::venue
