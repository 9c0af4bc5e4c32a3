// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_network.h"

#include <algorithm>
#include <utility>

namespace relucent::gui {

namespace {

struct NoSink : ProgressSink {
  void progressed(double, const Message&) override {}
};

}  // namespace

VenueNetwork::VenueNetwork(QObject* parent)
    : QObject(parent),
      searcher_([stop = stop_] {
        NoSink nobody;
        Progress progress(nobody, *stop);
        return pjlink::searchProjectors({}, progress);
      }),
      searching_(
          [this](const std::vector<pjlink::Found>& found) {
            wasSearched_ = true;
            found_.clear();
            for (const pjlink::Found& one : found)
              found_.append(QString::fromStdString(toString(one.address)));
            Q_EMIT changed();
          },
          [this](const Failure& failure) {
            Q_EMIT failed(failure);
            Q_EMIT changed();
          }) {}

VenueNetwork::~VenueNetwork() {
  stop_->ask(StopRequest::Kind::cancel);
}

VenueNetwork::Typed& VenueNetwork::at(std::size_t projector) {
  if (typed_.size() <= projector) typed_.resize(projector + 1);
  return typed_[projector];
}

QString VenueNetwork::address(std::size_t projector) const {
  return projector < typed_.size() ? typed_[projector].address : QString();
}

void VenueNetwork::setAddress(std::size_t projector, const QString& text) {
  const QString address = text.trimmed();
  if (address == this->address(projector)) return;
  at(projector).address = address;
  Q_EMIT changed();
}

QString VenueNetwork::password(std::size_t projector) const {
  return projector < typed_.size() ? typed_[projector].password : QString();
}

void VenueNetwork::setPassword(std::size_t projector, const QString& password) {
  if (password == this->password(projector)) return;
  at(projector).password = password;
  Q_EMIT changed();
}

void VenueNetwork::remove(std::size_t projector) {
  if (projector >= typed_.size()) return;
  typed_.erase(typed_.begin() + static_cast<std::ptrdiff_t>(projector));
  Q_EMIT changed();
}

void VenueNetwork::clear() {
  typed_.clear();
  Q_EMIT changed();
}

pipeline::NetworkProjectors VenueNetwork::wanted(std::size_t projectors) const {
  pipeline::NetworkProjectors wanted;
  for (std::size_t i = 0; i < std::min(projectors, typed_.size()); ++i) {
    std::optional<pjlink::Address> address = pjlink::addressFrom(typed_[i].address.toStdString());
    if (!address) continue;
    address->password = typed_[i].password.toStdString();
    wanted.addresses[i] = std::move(*address);
  }
  return wanted;
}

QString VenueNetwork::problem(std::size_t projectors) const {
  for (std::size_t i = 0; i < std::min(projectors, typed_.size()); ++i)
    if (!typed_[i].address.isEmpty() && !pjlink::addressFrom(typed_[i].address.toStdString()))
      return tr("“%1” is no network address of a projector. Write its number or name, as 192.168.1.50.")
          .arg(typed_[i].address);
  return {};
}

void VenueNetwork::search() {
  if (isSearching()) return;
  searching_.ask(searcher_);
  Q_EMIT changed();
}

}  // namespace relucent::gui
