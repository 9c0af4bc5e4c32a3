// SPDX-License-Identifier: MIT
#include "relucent/pipeline/projector_statuses.h"

#include <algorithm>

#include "relucent/base/error.h"

namespace relucent::pipeline {
namespace {

pjlink::Obedience obey(pjlink::Session& session, ProjectorOrder order) {
  switch (order) {
    case ProjectorOrder::on:
    case ProjectorOrder::off:
      return pjlink::switchPower(session, order == ProjectorOrder::on);
    case ProjectorOrder::open:
    case ProjectorOrder::close:
      break;
  }
  return pjlink::closeShutter(session, order == ProjectorOrder::close);
}

Message refusalOf(pjlink::Obedience obedience) {
  return obedience == pjlink::Obedience::cannot
             ? RELUCENT_ENGLISH_MESSAGE("pjlink.order-unknown", "it does not know this order")
             : RELUCENT_ENGLISH_MESSAGE("pjlink.order-not-now", "it does not carry out this order now");
}

ProjectorStatus statusOf(const pjlink::Address& address, const ProjectorStatusSettings& settings,
                         const Progress& progress) {
  ProjectorStatus status{address};
  try {
    pjlink::Session session(address, settings.patience, progress);
    if (settings.order)
      if (const pjlink::Obedience obedience = obey(session, *settings.order);
          obedience != pjlink::Obedience::done)
        status.remarks.push_back(refusalOf(obedience));
    status.report = pjlink::look(session);
    const std::string label = toString(address);
    for (const std::vector<Message>& more :
         {troublesOf(*status.report, label), harmfulSettings(*status.report, label, std::nullopt)})
      status.remarks.insert(status.remarks.end(), more.begin(), more.end());
  } catch (const Error& error) {
    status.problem = error.sentence();
  }
  return status;
}

}  // namespace

std::vector<ProjectorStatus> projectorStatuses(const ProjectorStatusSettings& settings, Progress& progress) {
  std::vector<pjlink::Address> addresses = settings.addresses;
  if (settings.search) {
    Progress searching = progress.part(
        0.5, RELUCENT_ENGLISH_MESSAGE("stage.searching-projectors", "Searching projectors on the network"));
    for (const pjlink::Found& found : pjlink::searchProjectors(*settings.search, searching))
      if (std::ranges::none_of(
              addresses, [&](const pjlink::Address& other) { return other.host == found.address.host; }))
        addresses.push_back(found.address);
  }
  std::vector<ProjectorStatus> statuses;
  for (const pjlink::Address& address : addresses) statuses.push_back(statusOf(address, settings, progress));
  progress.report(1.0);
  return statuses;
}

}  // namespace relucent::pipeline
