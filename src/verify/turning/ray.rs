//! One ray from the spindle axis, on which residues are measured.

/// A place of the surface with its outward normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Target {
    /// Distance from the axis along the ray, mm.
    pub(super) rho: f64,
    /// Height, mm.
    pub(super) z: f64,
    /// Unit outward normal on the workpiece.
    pub(super) normal: [f64; 3],
}

/// A ray in the direction of an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ray {
    /// Its angle, radians.
    pub(super) angle: f64,
    pub(super) cos: f64,
    pub(super) sin: f64,
}

impl Ray {
    pub(super) fn new(angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { angle, cos, sin }
    }
}

/// What a tool leaves along a ray.
pub(super) trait Sweep: Sync {
    /// The residue over each target along its normal, mm: below 0 where the tool digs in, infinite where it never comes near.
    fn residues(&self, ray: &Ray, targets: &[Target]) -> Vec<f64>;
}
