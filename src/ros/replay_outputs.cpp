// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay_outputs.h"

#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <system_error>

#include "conversions.h"
#include "palpate/base/error.h"
#include "topics.h"

namespace palpate::node {
namespace {

void openCsv(const std::string& part, std::ofstream* out) {
  out->open(part);
  if (!*out) throw InputError(part, "", "", "cannot be written");
  *out << std::setprecision(std::numeric_limits<double>::max_digits10);
}

void closeCsv(std::ofstream* out, PartFile* file) {
  out->close();
  if (!*out) throw InputError(file->part(), "", "", "cannot be written: disk full?");
  file->finish();
}

}  // namespace

PartFile::~PartFile() {
  if (!finished_) std::remove(part().c_str());
}

void PartFile::finish() {
  std::error_code error;
  std::filesystem::rename(part(), file_, error);
  if (error) throw InputError(file_, "", "", "cannot be written: " + error.message());
  finished_ = true;
}

ReplayBag::ReplayBag(const std::string& file, const sim::Scene& scene)
    : file_(file), scene_(scene) {
  try {
    bag_.open(file_.part(), rosbag::bagmode::Write);
  } catch (const rosbag::BagException& e) {
    throw InputError(file, "", "", std::string("cannot be written: ") + e.what());
  }
}

void ReplayBag::copy(const rosbag::MessageInstance& message, const ros::Time& stamp) {
  bag_.write(message.getTopic(), std::max(stamp, ros::TIME_MIN), message,
             message.getConnectionHeader());
}

void ReplayBag::write(const ros::Time& stamp, const sim::StepResult& result) {
  for (std::size_t i = 0; i < scene_.instruments.size(); ++i) {
    const sim::InstrumentConfig& config = scene_.instruments[i];
    const sim::InstrumentResult& r = result.instruments[i];
    bag_.write("/" + instrumentTopic(config.name, kSpatialWrench), stamp,
               toMsg(r.spatial, stamp, kWorldFrame));
    bag_.write("/" + instrumentTopic(config.name, kBodyWrench), stamp,
               toMsg(r.body, stamp, config.tf_prefix + config.control_frame));
  }
  const NodeState state = result.report.ok() ? NodeState::kRunning : NodeState::kFault;
  bag_.write(std::string("/") + kStepReportTopic, stamp, toMsg(result.report, state, stamp, 0.0));
}

void ReplayBag::finish() {
  bag_.close();
  file_.finish();
}

TrajectoryCsv::TrajectoryCsv(const std::string& file, const sim::Simulator& simulator)
    : file_(file) {
  const bool several = simulator.numInstruments() > 1;
  std::string header = "t";
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    const sim::InstrumentConfig& config =
        simulator.scene().instruments[static_cast<std::size_t>(i)];
    if (config.input == "tf") {
      throw InputError(file, "--trajectory", config.name,
                       "comes by tf, which has no joints to write");
    }
    for (const std::string& joint : simulator.instrument(i).jointNames()) {
      header += "," + (several ? config.name + "/" + joint : joint);
    }
  }
  openCsv(file_.part(), &out_);
  out_ << header << '\n';
}

void TrajectoryCsv::write(double t, const std::vector<Eigen::VectorXd>& joints) {
  out_ << t;
  for (const Eigen::VectorXd& q : joints) {
    for (Eigen::Index k = 0; k < q.size(); ++k) out_ << ',' << q[k];
  }
  out_ << '\n';
}

void TrajectoryCsv::finish() { closeCsv(&out_, &file_); }

ResultCsv::ResultCsv(const std::string& file, const sim::Simulator& simulator) : file_(file) {
  openCsv(file_.part(), &out_);
  const bool several = simulator.numInstruments() > 1;
  out_ << "t";
  for (const sim::InstrumentConfig& instrument : simulator.scene().instruments) {
    const std::string prefix = several ? instrument.name + "/" : "";
    for (const char* column : {"fx", "fy", "fz", "tx", "ty", "tz", "contacts", "max_penetration"}) {
      out_ << ',' << prefix << column;
    }
  }
  out_ << ",newton_iterations,cg_iterations,residual,min_jacobian,kinetic_energy,elastic_energy,"
          "status,step_ms,skipped\n";
}

void ResultCsv::write(double t, const sim::StepResult& result, double step_ms) {
  out_ << t;
  for (const sim::InstrumentResult& r : result.instruments) {
    for (int k = 0; k < 3; ++k) out_ << ',' << r.spatial.force[k];
    for (int k = 0; k < 3; ++k) out_ << ',' << r.spatial.torque[k];
    out_ << ',' << r.contacts << ',' << r.max_penetration;
  }
  const sim::StepReport& report = result.report;
  out_ << ',' << report.newton_iterations << ',' << report.cg_iterations << ',' << report.residual
       << ',' << report.min_jacobian << ',' << report.kinetic_energy << ',' << report.elastic_energy
       << ',' << solver::toString(report.status) << ',' << step_ms << ',' << report.skipped.total()
       << '\n';
}

void ResultCsv::finish() { closeCsv(&out_, &file_); }

}  // namespace palpate::node
