//! sRGB in and out of linear light.

use std::sync::LazyLock;

use super::vector::V3;

const STEPS: usize = 4096;
/// Linear light up to here is shown as it is; above, highlights are bent towards white.
const SHOULDER: f32 = 0.6;

/// Bytes for linear light in steps: the transfer function of IEC 61966-2-1.
static ENCODED: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let byte = |n: usize| {
        let linear = n as f64 / (STEPS - 1) as f64;
        let encoded = if linear <= 0.003_130_8 {
            12.92 * linear
        } else {
            1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
        };
        libm::round(encoded * 255.0) as u8
    };
    (0..STEPS).map(byte).collect()
});

/// Linear light of an sRGB colour of parts 0 to 1 (IEC 61966-2-1).
pub(in crate::simulation) fn linear(srgb: [f32; 3]) -> V3 {
    srgb.map(|part| {
        let part = f64::from(part.clamp(0.0, 1.0));
        let light =
            if part <= 0.040_45 { part / 12.92 } else { libm::pow((part + 0.055) / 1.055, 2.4) };
        light as f32
    })
}

/// The sRGB bytes for linear light of any strength.
pub(in crate::simulation) fn encode(light: V3) -> [u8; 3] {
    let table: &[u8] = &ENCODED;
    light.map(|part| table[(shoulder(part) * (STEPS - 1) as f32 + 0.5) as usize])
}

/// Bends strong light below 1: continuous with slope 1 at the shoulder, 1 at infinity.
fn shoulder(light: f32) -> f32 {
    let over = light - SHOULDER;
    if over <= 0.0 {
        return light.max(0.0);
    }
    let room = 1.0 - SHOULDER;
    SHOULDER + room * over / (room + over)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_come_back_up_to_the_shoulder() {
        for byte in 0..=200_u8 {
            let part = f32::from(byte) / 255.0;
            assert_eq!(encode(linear([part; 3])), [byte; 3]);
        }
    }

    #[test]
    fn light_of_any_strength_has_a_colour() {
        assert_eq!(encode([-1.0, f32::INFINITY, 1e9]), [0, 0, 255]);
        assert_eq!(encode([f32::NAN, 0.0, 1e30]), [0, 0, 255]);
    }
}
