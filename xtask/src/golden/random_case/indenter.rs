//! `[indenter]`: every kind, rigid or elastic.

use super::draw::Draw;
use super::{Scales, map};

const KINDS: [&str; 11] = [
    "paraboloid",
    "paraboloid",
    "paraboloid",
    "sphere",
    "sphere",
    "cone",
    "berkovich",
    "vickers",
    "cube-corner",
    "flat-punch",
    "map",
];

pub fn draw(draw: &mut Draw, scales: Scales) {
    let kind = draw.pick(&KINDS);
    draw.line(format!("[indenter]\nkind = \"{kind}\""));
    match kind {
        "map" => {
            let curvature = 1.0 / (2.0 * scales.radius);
            let half = 0.5 * map::side(scales);
            // A paraboloid z = r²/(2R) about the centre of the map.
            map::draw(draw, "indenter", scales, |[x, y]| {
                curvature * ((2.0 * x - 1.0).powi(2) + (2.0 * y - 1.0).powi(2)) * half * half
            });
        }
        "cone" => {
            let angle = 88_f64.to_radians() - 0.2 * draw.part();
            key_of_angle(draw, "half_angle", angle);
            tip(draw, scales);
        }
        "berkovich" | "vickers" | "cube-corner" => {
            if draw.one_in(3) {
                let angle = 70_f64.to_radians() + 0.3 * draw.part();
                key_of_angle(draw, "face_angle", angle);
            }
            tip(draw, scales);
        }
        _ => {
            let radius = match kind {
                "flat-punch" => scales.contact,
                _ => scales.radius,
            };
            let radius = draw.length(radius);
            draw.line(format!("radius = {radius}"));
        }
    }
    if draw.one_in(5) {
        let modulus = scales.modulus * draw.decades([0.5, 100.0]);
        let modulus = draw.pressure(modulus);
        draw.line(format!("young_modulus = {modulus}\npoisson_ratio = 0.1"));
    }
}

fn key_of_angle(draw: &mut Draw, key: &str, angle: f64) {
    let angle = draw.angle(angle);
    draw.line(format!("{key} = {angle}"));
}

/// A rounded tip, or now and then a sharp one.
fn tip(draw: &mut Draw, scales: Scales) {
    if !draw.one_in(4) {
        let radius = draw.length(scales.contact);
        draw.line(format!("tip_radius = {radius}"));
    }
}
