#pragma once

namespace vitrum {

/// When an explicit step updates the stress of particles: first, last, or last after momenta have been
/// projected anew.
enum class StepScheme { usf, usl, musl };

}  // namespace vitrum
