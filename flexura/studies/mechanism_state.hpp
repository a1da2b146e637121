#pragma once

#include "flexura/assembly/motion_system.hpp"
#include "flexura/assembly/system.hpp"

namespace flexura {

/// Where a mechanism is, whatever kind of system its unknowns belong to.
class MechanismState {
 public:
  virtual ~MechanismState() = default;
  virtual bool linearised() const = 0;
  virtual Pose pose(std::size_t body) const = 0;
  virtual Vec2 moved_point(std::size_t body, Vec2 drawn) const = 0;
  virtual Pose base_section(std::size_t member) const = 0;
  /// In axes of the base section, as a port gives them.
  virtual std::vector<SectionState> sections(std::size_t member) const = 0;
  /// Of the drawn state.
  virtual std::vector<SectionState> drawn_sections(std::size_t member) const = 0;
  virtual std::vector<Vec2> drawn_axis(std::size_t member,
                                       const std::vector<SectionState>& sections) const = 0;
  /// As a port gives it; absent where it has none.
  virtual std::optional<StressField> stress_field(std::size_t /*member*/) const {
    return std::nullopt;
  }
};

/// An equilibrium.
class StillState final : public MechanismState {
 public:
  StillState(const System& system, const std::vector<double>& z) : system_(system), z_(z) {}
  bool linearised() const override { return system_.linearised(); }
  Pose pose(std::size_t body) const override { return system_.pose(body, z_); }
  Vec2 moved_point(std::size_t body, Vec2 drawn) const override {
    return system_.moved_point(body, drawn, z_);
  }
  Pose base_section(std::size_t member) const override { return system_.base_section(member, z_); }
  std::vector<SectionState> sections(std::size_t member) const override {
    return port(member).sections_in(system_.surroundings(member, z_),
                                    system_.member_load(member, z_), system_.internal(member, z_));
  }
  std::vector<SectionState> drawn_sections(std::size_t member) const override {
    return port(member).sections(Eigen::Vector3d::Zero(),
                                 std::vector<double>(port(member).internal_size(), 0.0));
  }
  std::vector<Vec2> drawn_axis(std::size_t member,
                               const std::vector<SectionState>& sections) const override {
    return port(member).drawn_axis(sections, system_.internal(member, z_));
  }
  std::optional<StressField> stress_field(std::size_t member) const override {
    return port(member).stress_field(system_.internal(member, z_));
  }

 private:
  const TwoPort& port(std::size_t member) const { return *system_.layout().members[member].port; }
  const System& system_;
  const std::vector<double>& z_;
};

/// A moment of a motion.
class MovingState final : public MechanismState {
 public:
  MovingState(const MotionSystem& system, const Moment& moment)
      : system_(system), moment_(moment) {}
  bool linearised() const override { return system_.linearised(); }
  Pose pose(std::size_t body) const override { return system_.pose(body, moment_.q); }
  Vec2 moved_point(std::size_t body, Vec2 drawn) const override {
    return system_.moved_point(body, drawn, moment_.q);
  }
  Pose base_section(std::size_t member) const override {
    return system_.base_section(member, moment_.q);
  }
  std::vector<SectionState> sections(std::size_t member) const override {
    return system_.port(member).sections(system_.member_load(member, moment_.multipliers),
                                         system_.internal(member, moment_.q));
  }
  std::vector<SectionState> drawn_sections(std::size_t member) const override {
    const MotionPort& port = system_.port(member);
    return port.sections(Eigen::Vector3d::Zero(),
                         std::vector<double>(port.internal_size(), 0.0).data());
  }
  std::vector<Vec2> drawn_axis(std::size_t member,
                               const std::vector<SectionState>& sections) const override {
    return system_.port(member).drawn_axis(sections, system_.internal(member, moment_.q));
  }
  std::optional<StressField> stress_field(std::size_t member) const override {
    return system_.port(member).stress_field(system_.internal(member, moment_.q));
  }

 private:
  const MotionSystem& system_;
  const Moment& moment_;
};

}  // namespace flexura
