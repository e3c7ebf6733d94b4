//! `[foundation]`: up to three layers, which need not be bonded or homogeneous, on an elastic or a rigid base.

use super::Scales;
use super::draw::Draw;

const POISSON_RATIOS: [f64; 5] = [0.0, 0.2, 0.3, 0.45, 0.5];

pub fn draw(draw: &mut Draw, scales: Scales) {
    let count = draw.below(4);
    draw.line("[foundation]");
    if count > 0 && draw.one_in(6) {
        draw.line("substrate = \"rigid\"");
    } else {
        let mut keys = vec![format!("young_modulus = {}", draw.pressure(scales.modulus))];
        keys.push(format!("poisson_ratio = {}", draw.pick(&POISSON_RATIOS)));
        keys.extend(strengths(
            draw,
            scales,
            &["yield_strength", "tensile_strength"],
            5,
        ));
        if count == 0 && draw.one_in(10) {
            keys.push(hardness(draw, scales));
        }
        draw.line(format!("substrate = {{ {} }}", keys.join(", ")));
    }
    for layer in 0..count {
        draw.line("[[foundation.layer]]");
        self::layer(draw, scales);
        if layer == 0 && draw.one_in(10) {
            let hardness = hardness(draw, scales);
            draw.line(hardness);
        }
    }
}

fn layer(draw: &mut Draw, scales: Scales) {
    let thickness = scales.contact * draw.decades([0.1, 10.0]);
    let thickness = draw.length(thickness);
    draw.line(format!("thickness = {thickness}"));
    let modulus = scales.modulus * draw.decades([0.1, 10.0]);
    let modulus = modulus_text(draw, modulus, scales);
    draw.line(format!("young_modulus = {modulus}"));
    let ratio = draw.pick(&POISSON_RATIOS);
    draw.line(format!("poisson_ratio = {ratio}"));
    match draw.below(9) {
        0 => draw.line("interface = \"bonded\""),
        1 => draw.line("interface = \"frictionless\""),
        2 => {
            let size = scales.contact / scales.modulus;
            let [normal, shear] = [0, 1].map(|_| size * draw.decades([0.01, 1.0]));
            let [normal, shear] = [normal, shear].map(|compliance| draw.compliance(compliance));
            let springs = format!("normal_compliance = {normal}, shear_compliance = {shear}");
            draw.line(format!("interface = {{ {springs} }}"));
        }
        _ => {}
    }
    let keys = [
        "yield_strength",
        "tensile_strength",
        "interface_shear_strength",
        "interface_tensile_strength",
    ];
    for strength in strengths(draw, scales, &keys, 6) {
        draw.line(strength);
    }
}

/// A uniform modulus, or now and then one that changes through the layer to that of the base.
fn modulus_text(draw: &mut Draw, modulus: f64, scales: Scales) -> String {
    if !draw.one_in(6) {
        return draw.pressure(modulus);
    }
    let [from, to] = [modulus, scales.modulus].map(|end| draw.pressure(end));
    let profile = draw.pick(&["linear", "exponential"]);
    format!("{{ from = {from}, to = {to}, profile = \"{profile}\" }}")
}

fn strengths(draw: &mut Draw, scales: Scales, keys: &[&str], one_in: u32) -> Vec<String> {
    let mut found = Vec::new();
    for key in keys {
        if draw.one_in(one_in) {
            let strength = scales.pressure() * draw.decades([0.02, 2.0]);
            found.push(format!("{key} = {}", draw.pressure(strength)));
        }
    }
    found
}

/// A limit of the pressure, mostly below Hertz's largest pressure.
pub fn hardness(draw: &mut Draw, scales: Scales) -> String {
    let hardness = scales.pressure() * draw.decades([0.1, 1.0]);
    format!("hardness = {}", draw.pressure(hardness))
}
