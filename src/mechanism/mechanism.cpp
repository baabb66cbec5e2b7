#include "fusee/mechanism.h"

#include <utility>

namespace fusee {

Mechanism::Mechanism() = default;
Mechanism::Mechanism(const Mechanism&) = default;
Mechanism::Mechanism(Mechanism&&) noexcept = default;
Mechanism& Mechanism::operator=(const Mechanism&) = default;
Mechanism& Mechanism::operator=(Mechanism&&) noexcept = default;
Mechanism::~Mechanism() = default;

DeclaredMechanism::DeclaredMechanism() = default;
DeclaredMechanism::DeclaredMechanism(Mechanism mechanism) : Mechanism(std::move(mechanism)) {}
DeclaredMechanism::DeclaredMechanism(const DeclaredMechanism&) = default;
DeclaredMechanism::DeclaredMechanism(DeclaredMechanism&&) noexcept = default;
DeclaredMechanism& DeclaredMechanism::operator=(const DeclaredMechanism&) = default;
DeclaredMechanism& DeclaredMechanism::operator=(DeclaredMechanism&&) noexcept = default;
DeclaredMechanism::~DeclaredMechanism() = default;

}  // namespace fusee
