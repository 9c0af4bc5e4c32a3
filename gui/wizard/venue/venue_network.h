// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <vector>

#include "jobs/latest.h"
#include "relucent/base/progress.h"
#include "relucent/pipeline/network_projectors.h"
#include "relucent/pjlink/search.h"

namespace relucent::gui {

/// Where the projectors of a new venue are on the network, as it is typed, and who is found there.
class VenueNetwork : public QObject {
  Q_OBJECT

 public:
  explicit VenueNetwork(QObject* parent = nullptr);
  /// Ends a search.
  ~VenueNetwork() override;

  /// "HOST[:PORT]"; empty: it is not on the network.
  QString address(std::size_t projector) const;
  void setAddress(std::size_t projector, const QString& text);
  QString password(std::size_t projector) const;
  void setPassword(std::size_t projector, const QString& password);
  /// Those behind it move up.
  void remove(std::size_t projector);
  void clear();

  /// Of the first `projectors`. What is no address is left out, and has a sentence.
  pipeline::NetworkProjectors wanted(std::size_t projectors) const;
  /// Empty: nothing stands against it.
  QString problem(std::size_t projectors) const;

  /// Asks who is there, on another thread; may take some seconds.
  void search();
  bool isSearching() const { return searching_.isBusy(); }
  bool wasSearched() const { return wasSearched_; }
  /// Addresses of those that answered.
  const QStringList& found() const { return found_; }
  /// Who searches; for tests.
  void setSearcher(std::function<std::vector<pjlink::Found>()> searcher) { searcher_ = std::move(searcher); }

 Q_SIGNALS:
  void changed();
  void failed(const gui::Failure& failure);

 private:
  struct Typed {
    QString address, password;
  };
  Typed& at(std::size_t projector);

  std::vector<Typed> typed_;
  QStringList found_;
  bool wasSearched_ = false;
  std::shared_ptr<StopRequest> stop_ = std::make_shared<StopRequest>();
  std::function<std::vector<pjlink::Found>()> searcher_;
  Latest<std::vector<pjlink::Found>> searching_;
};

}  // namespace relucent::gui
