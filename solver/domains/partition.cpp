#include "domains/partition.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/initial_overlap.hpp"
#include "contact/search_params.hpp"
#include "domains/first_division.hpp"
#include "domains/motion_limit.hpp"
#include "domains/piece_mesh.hpp"
#include "domains/state_records.hpp"
#include "model/parameters.hpp"
#include "model/surfaces_to_break.hpp"
#include "parallel/totals.hpp"

namespace breccia {
namespace {

/// The margin is stretched, but no further than this, so that at the present speed nodes use it up in so many steps.
constexpr double kLasting = 400, kMostStretched = 5;

}  // namespace

Partition::Partition(const case_::Case& input, const Communicator& communicator, std::unique_ptr<Model> model,
                     const std::function<void()>& between)
    : input_(input), communicator_(communicator), model_(std::move(model)), domains_(domain_spec(input)) {
  const std::function<void()> poll = between ? between : [] {};
  if (communicator_.size() == 1) {
    start_alone(poll);
  } else {
    start_divided(poll);
  }
}

void Partition::start_alone(const std::function<void()>& poll) {
  poll();
  domain_ = std::make_unique<Domain>(*model_, search_params(input_, *model_));
  poll();
  for (const InitialVelocity& initial : initial_velocities(input_, *model_)) add_velocity(*domain_, initial);
  poll();
  time_step_ = std::make_unique<TimeStep>(*model_);
  poll();
  model_->whole.step_ratio = time_step_->ratio();
  if (domain_->contact) model_->whole.contactor_size = domain_->contact->searches().contactor_size();
  relax_overlaps();
}

void Partition::relax_overlaps() {
  if (domain_->contact)
    relax_initial_overlaps(model_->contact, model_->local, domain_->state.nodes.position, domain_->state.contact);
}

/// The root holds the bare model until its elements have left for the ranks; each of them builds its own piece.
void Partition::start_divided(const std::function<void()>& poll) {
  communicator_.set_phase("first division of the model");
  std::vector<std::byte> packed;
  Contactors contactors;
  if (model_) {
    if (model_->has_contact)
      contactors = choose_contactors(model_->breakable, model_->mesh, model_->topology,
                                     model_->plane ? model_->plane->axis : -1);
    model_->whole.contactor_size = contactors.size;
    packed = pack(model_->whole);
  }
  poll();
  communicator_.broadcast(packed);
  WholeModel whole = unpack_whole(packed);
  Records mine = spread(communicator_, model_.get(), contactors);
  model_.reset();
  contactors = {};
  poll();
  const std::vector<Discretisation> kinds = discretisations(input_, whole.volume_groups);
  const std::vector<double> weight = Balance::weights_at_rest(mine, kinds);
  decompose_anew(std::move(whole), std::move(mine), weight, {});
  poll();
  start_piece(poll);
}

void Partition::start_piece(const std::function<void()>& poll) {
  start_joints(*domain_);
  for (const InitialVelocity& initial : initial_velocities(input_, *model_)) add_velocity(*domain_, initial);
  State& state = domain_->state;
  domain_->exchange.finish_reduction(state.clock, state.signals);  // begun when nothing moved yet
  domain_->exchange.begin_reduction(state.clock, state.signals);
  NodalState& nodes = state.nodes;
  domain_->exchange.begin_gather(nodes.position, nodes.velocity);
  domain_->exchange.finish_gather();
  poll();
  relax_overlaps();
  model_->whole.step_ratio = time_step_->ratio();
  motion_ = first_motion();
  if (stretch() > 1) divide_again();
}

/// How far a node of the model moves in a step at the start, m.
double Partition::first_motion() const {
  const NodalState& nodes = domain_->state.nodes;
  double square = 0;
  for (Index n = 0; n < model_->local.num_moved_nodes; ++n)
    square = std::max(square, load_node(nodes.velocity.data(), n).squaredNorm());
  const double limit = communicator_.min(time_step_->limit(nodes.position));
  return std::sqrt(communicator_.max(square)) * (input_.time.step > 0 ? input_.time.step : input_.time.safety * limit);
}

/// What the other ranks contribute to iterations over the nodes of the model.
RankOperations Partition::rank_operations() const {
  if (communicator_.size() == 1) return {};
  return {[this](Field<double>& field) {
            Field<double> none(field.size(), 0.0);
            domain_->exchange.begin_gather(field, none);
            domain_->exchange.finish_gather();
          },
          [this](const ExactSum& sum) { return totals(communicator_, std::span(&sum, 1)).front(); },
          [this](double value) { return communicator_.max(value); }};
}

Partition::Partition(const case_::Case& input, const Communicator& communicator, Snapshot from)
    : input_(input),
      communicator_(communicator),
      domains_(std::move(from.domains)),
      stage_(from.in_stage ? &input.stages[from.stage] : nullptr),
      motion_(from.motion) {
  decompose_anew(std::move(from.whole), std::move(from.mine), from.weight, from.state);
  model_->whole.step_ratio = time_step_->ratio();
}

Snapshot Partition::opened() const {
  return {model_->whole,
          records_of(*domain_),
          costs(),
          {},
          domains_,
          motion_,
          static_cast<std::size_t>(stage_ - input_.stages.data())};
}

Snapshot Partition::snapshot() {
  Snapshot now = opened();
  now.state = close(*domain_);
  return now;
}

Snapshot Partition::copy() const {
  domain_->exchange.agree_on_failure();
  return copy_of_rank();
}

Snapshot Partition::copy_of_rank() const {
  Snapshot now = opened();
  now.state = {closed_fields(*domain_), domain_->timer, domain_->sample};
  return now;
}

void Partition::decompose_anew(WholeModel whole, Records mine, const std::vector<double>& weight,
                               const Continuation& from) {
  communicator_.set_phase("division of the model");
  const Phase phase = stage_ != nullptr ? Phase::decomposition : Phase::setup;  // the first one is before all stages
  PhaseTimer timer;
  {
    const auto timing = timer.measure(phase);
    rebuild(std::move(whole), std::move(mine), weight, from);
  }
  decomposition_s_ = communicator_.max(timer.seconds(phase));
  domain_->timer.add(timer);
  balance_.restart(*domain_);
}

void Partition::rebuild(WholeModel whole, Records mine, const std::vector<double>& weight, const Continuation& from) {
  domain_.reset();
  time_step_.reset();
  model_.reset();
  const Sizes sizes = sizes_of_all(communicator_, longest_edges(mine));
  reach_ = reach_of(input_, sizes.mean, largest_buffer(input_.detection.buffer, whole.contactor_size));
  reach_.margin *= stretch();
  build(decompose(communicator_, domains_, std::move(mine), weight, sizes, reach_), std::move(whole), from);
}

/// Of the margin as the case has it, at the present speed.
double Partition::stretch() const {
  return std::clamp(kLasting * motion_ / reach_.allowed_motion(), 1.0, kMostStretched);
}

void Partition::build(const Piece& piece, WholeModel whole, const Continuation& from) {
  const double dt = from.state.clock.dt;
  Mesh mesh = mesh_of(piece.records, whole);
  Topology topology = topology_of(piece.records, mesh);
  std::vector<std::uint8_t> torn;
  for (const ElementRecord& record : piece.records.elements) torn.push_back(record.torn);
  model_ = std::make_unique<Model>(build_piece(input_, std::move(whole), std::move(mesh), std::move(topology),
                                               piece.original, piece.records.corners, std::move(torn)));
  domain_ = std::make_unique<Domain>(*model_, search_params(input_, *model_), piece.records, from);
  const bool pairwise = input_.domains.exchange == case_::Exchange::pairwise;
  if (communicator_.size() > 1)
    domain_->connect(communicator_, shared_slots(piece.neighbours, model_->mesh, model_->local),
                     pairwise ? ExchangeKind::pairwise : ExchangeKind::non_blocking);
  record_motion_before_last(*domain_);
  time_step_ = std::make_unique<TimeStep>(*model_, rank_operations());
  if (stage_ != nullptr) {
    breccia::begin_stage(*domain_, stage_loads(*stage_, *model_), dt);
    restore_holds(*domain_, piece.records);
  }
  anchor_ = domain_->state.nodes.position;
  moved_.restart();
}

void Partition::refuse_what_cannot_break() const {
  std::vector<SurfaceJoints> joints = joints_on(*model_, surfaces_to_break(input_));
  for (SurfaceJoints& of_surface : joints)
    of_surface = {communicator_.sum(of_surface.breakable), communicator_.sum(of_surface.unbreakable)};
  breccia::refuse_what_cannot_break(input_, joints);
}

void Partition::begin_stage(const case_::Stage& stage) {
  stage_ = &stage;
  for (const std::string& surface : stage.broken_surfaces) break_joints(*domain_, faces_of_surface(*model_, surface));
  breccia::begin_stage(*domain_, stage_loads(stage, *model_), domain_->state.clock.dt);
  domain_->state.signals.step_motion.stage_step = domain_->state.clock.steps;
}

StepState Partition::step_state() const {
  const State& state = domain_->state;
  return {state.nodes.position,     state.nodes.velocity,
          domain_->contacts(),      domain_->contact ? &domain_->contact->clusters() : nullptr,
          &state.loads.constraints, material_memory(state.elements),
          state.loads.local_damping};
}

StableStep Partition::stable_step(double steps) const {
  const auto timing = domain_->timer.measure(Phase::stable_step);
  return global_stable_step(communicator_, *time_step_, step_state(), steps);
}

double Partition::step_length(double steps, const StepRange& range) const {
  const auto timing = domain_->timer.measure(Phase::stable_step);
  return global_step_length(communicator_, *time_step_, step_state(), steps, range);
}

double Partition::step_length(const case_::Stage& stage, double steps) const {
  const auto timing = domain_->timer.measure(Phase::stable_step);
  const StageLoads loads = stage_loads(stage, *model_);
  StepState state = step_state();
  state.constraints = &loads.constraints;
  state.local_damping = loads.local_damping;
  return global_step_length(communicator_, *time_step_, state, steps);
}

void Partition::keep_up() {
  if (communicator_.size() == 1) return;
  const bool due = left_reach(), pays = balancing_pays();
  if (!due && !pays) return;
  divide_again();
  ++decompositions_;
}

void Partition::divide_again() {
  const std::vector<double> weight = balance_.weights(*domain_);
  Records mine = records_of(*domain_);
  decompose_anew(model_->whole, std::move(mine), weight, close(*domain_));
}

/// Rebalance when accumulated waiting exceeds the cost of a rebalance: at most twice the optimal cost. A grid is fixed,
/// for any content of its cuboids.
bool Partition::balancing_pays() {
  if (domain_->state.clock.steps % Balance::kInterval != 0) return false;
  const double lost = balance_.look(*domain_);
  return input_.domains.rebalance && domains_.kind == DomainKind::rcb && lost > decomposition_s_;
}

/// The next step is counted beforehand: two steps are not known yet, the second of which may go four times as far as
/// the last that is.
bool Partition::left_reach() {
  motion_ = domain_->state.signals.motion;
  moved_.step(motion_);
  return moved_.used_up(reach_.allowed_motion(), 2 * motion_ + 4 * unforeseen_motion(*domain_, kMotionLate),
                        model_->local, domain_->state.nodes.position, anchor_, communicator_);
}

}  // namespace breccia
