// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay_outputs.h"

#include <algorithm>
#include <exception>

#include "palpate/base/error.h"
#include "palpate/io/replay_table.h"
#include "ros/messages/conversions.h"
#include "ros/messages/topics.h"

namespace palpate::node {

template <class Action>
void ReplayBag::writing(const Action& action) {
  try {
    action();
  } catch (const rosbag::BagException& e) {
    throw InputError(name_, "", "", std::string("cannot be written: ") + e.what());
  }
}

ReplayBag::ReplayBag(const std::string& file, const scene::Scene& scene)
    : name_(file), file_(file), scene_(scene), bag_(new rosbag::Bag) {
  writing([&] { bag_->open(file_.part(), rosbag::bagmode::Write); });
}

void ReplayBag::Close::operator()(rosbag::Bag* bag) const {
  try {
    bag->close();
  } catch (const std::exception&) {
    return;
  }
  delete bag;
}

void ReplayBag::copy(const rosbag::MessageInstance& message, const ros::Time& stamp) {
  writing([&] {
    bag_->write(message.getTopic(), std::max(stamp, ros::TIME_MIN), message,
                message.getConnectionHeader());
  });
}

void ReplayBag::write(const ros::Time& stamp, const sim::StepResult& result) {
  writing([&] {
    for (std::size_t i = 0; i < scene_.instruments.size(); ++i) {
      const scene::InstrumentConfig& config = scene_.instruments[i];
      const sim::InstrumentResult& r = result.instruments[i];
      bag_->write("/" + instrumentTopic(config.name, kSpatialWrench), stamp,
                  toMsg(r.spatial, stamp, kWorldFrame));
      bag_->write("/" + instrumentTopic(config.name, kBodyWrench), stamp,
                  toMsg(r.body(), stamp, config.tf_prefix + config.control_frame));
    }
    const NodeState state = result.report.usable() ? NodeState::kRunning : NodeState::kFault;
    sim::StepReport report = result.report;
    report.phases = PhaseTimes();
    bag_->write(std::string("/") + kStepReportTopic, stamp, toMsg(report, state, stamp, 0.0));
  });
}

// Latched, so that who plays the bag hears it whenever.
void ReplayBag::write(const palpate::RunRecord& record) {
  namespace traits = ros::message_traits;
  const auto connection = boost::make_shared<ros::M_string>();
  (*connection)["type"] = traits::datatype(record);
  (*connection)["md5sum"] = traits::md5sum(record);
  (*connection)["message_definition"] = traits::definition(record);
  (*connection)["latching"] = "1";
  writing([&] {
    bag_->write(std::string("/") + kRunRecordTopic, std::max(record.header.stamp, ros::TIME_MIN),
                record, connection);
  });
}

void ReplayBag::finish() {
  writing([&] { bag_->close(); });
  file_.commit();
}

TrajectoryCsv::TrajectoryCsv(const std::string& file, const sim::Simulator& simulator)
    : file_(file), part_(file) {
  const bool several = simulator.numInstruments() > 1;
  std::vector<std::string> header = {"t"};
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    const scene::InstrumentConfig& config =
        simulator.scene().instruments[static_cast<std::size_t>(i)];
    if (config.input == "tf") {
      throw InputError(file, "--trajectory", config.name,
                       "comes by tf, which has no joints to write");
    }
    for (const std::string& joint : simulator.instrument(i).jointNames()) {
      header.push_back(several ? config.name + "/" + joint : joint);
    }
  }
  csv_ = std::make_unique<io::CsvWriter>(part_.part(), header);
}

void TrajectoryCsv::write(double t, const std::vector<Eigen::VectorXd>& joints) {
  if (begun_ && t == last_) return;
  if (begun_ && t < last_) {
    throw InputError(file_, "--trajectory", "",
                     "time goes back in the bag, which a trajectory cannot; cut the bag there");
  }
  begun_ = true;
  last_ = t;
  *csv_ << t;
  for (const Eigen::VectorXd& q : joints) {
    for (Eigen::Index k = 0; k < q.size(); ++k) *csv_ << q[k];
  }
  csv_->endRow();
}

void TrajectoryCsv::finish() {
  csv_->close();
  part_.commit();
}

ResultCsv::ResultCsv(const std::string& file, const scene::Scene& scene)
    : part_(file), csv_(part_.part(), io::replayColumns(scene)) {}

void ResultCsv::write(double t, const sim::StepResult& result, double step_ms) {
  io::writeReplayRow(t, result, step_ms, &csv_);
}

void ResultCsv::finish() {
  csv_.close();
  part_.commit();
}

}  // namespace palpate::node
