// SPDX-License-Identifier: MIT
#include "wizard/venue/network_list_view.h"

#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/venue_page.h"

namespace relucent::gui {
namespace {

class AddressRow : public QWidget {
 public:
  AddressRow(VenuePage& model, std::size_t projector) : model_(model), projector_(projector) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    address_ = new QComboBox;
    address_->setObjectName(QString("projector-address-%1").arg(projector + 1));
    address_->setEditable(true);
    address_->setInsertPolicy(QComboBox::NoInsert);
    address_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    column->addWidget(address_);
    password_ = new QLineEdit;
    password_->setObjectName(QString("projector-password-%1").arg(projector + 1));
    password_->setEchoMode(QLineEdit::Password);
    column->addWidget(password_);
    VenueNetwork& network = model.network();
    connect(address_, &QComboBox::editTextChanged, &network,
            [&network, projector](const QString& text) { network.setAddress(projector, text); });
    connect(password_, &QLineEdit::textEdited, &network,
            [&network, projector](const QString& text) { network.setPassword(projector, text); });
  }

  void refresh(bool isAlone) {
    const QString which = VenuePage::tr("Projector %1").arg(projector_ + 1);
    const QString what = VenuePage::tr("Network address (PJLink)"),
                  secret = VenuePage::tr("Password, if it has one");
    const auto named = [&](const QString& text) {
      return isAlone ? text : QString("%1: %2").arg(which, text);
    };
    const VenueNetwork& network = model_.network();
    const QSignalBlocker quiet(address_);
    QStringList known;
    for (int i = 0; i < address_->count(); ++i) known.append(address_->itemText(i));
    const QString text = network.address(projector_);
    if (known != network.found()) {
      address_->clear();
      address_->addItems(network.found());
      address_->setCurrentIndex(-1);
    }
    if (address_->currentText().trimmed() != text) address_->setEditText(text);
    address_->lineEdit()->setPlaceholderText(named(what));
    address_->setAccessibleName(named(what));
    password_->setPlaceholderText(secret);
    password_->setAccessibleName(named(secret));
    if (password_->text() != network.password(projector_)) password_->setText(network.password(projector_));
    password_->setVisible(!text.isEmpty());
  }

 private:
  VenuePage& model_;
  std::size_t projector_;
  QComboBox* address_;
  QLineEdit* password_;
};

}  // namespace

QWidget* networkList(VenuePage& model) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(VenuePage::tr("On the network"), "section"));
  column->addWidget(
      labelOf(VenuePage::tr("Optional: a projector with a network address is switched on, and its lamp "
                            "waited for until it is steady, before anything is measured."),
              "note"));
  auto* rows = new QVBoxLayout;
  column->addLayout(rows);
  QPushButton* search = buttonOf(VenuePage::tr("Find projectors"));
  search->setObjectName("find-projectors");
  QObject::connect(search, &QPushButton::clicked, &model.network(), &VenueNetwork::search);
  column->addWidget(search);
  QLabel* found = labelOf({}, "note");
  found->setObjectName("projectors-found");
  column->addWidget(found);
  auto all = std::make_shared<std::vector<AddressRow*>>();
  auto refresh = [&model, part, rows, search, found, all] {
    const std::size_t count = model.projectors().size();
    part->setVisible(count > 0);
    while (all->size() > count) {
      all->back()->hide();
      all->back()->deleteLater();
      all->pop_back();
    }
    while (all->size() < count) {
      all->push_back(new AddressRow(model, all->size()));
      rows->addWidget(all->back());
    }
    for (AddressRow* row : *all) row->refresh(count == 1);
    const VenueNetwork& network = model.network();
    setPossible(search, network.isSearching() ? VenuePage::tr("Looking for projectors…") : QString());
    found->setVisible(network.isSearching() || network.wasSearched());
    const auto answered = static_cast<int>(network.found().size());
    found->setText(network.isSearching() ? VenuePage::tr("Looking for projectors…")
                   : answered == 0
                       ? VenuePage::tr("None answers. Only PJLink class 2 can be searched: type the address.")
                       : VenuePage::tr("%n answer. Choose from the list of each.", nullptr, answered));
  };
  refreshOn(model, part, refresh, &VenuePage::settingsChanged);
  return part;
}

}  // namespace relucent::gui
