//! Cases with a layered indenter: what must not depend on which body is called the indenter, on units, or on how a
//! layer is written.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

use pellicle::Case;
use pellicle::input::span::Source;
use pellicle::input::units::Units;
use pellicle::result::table::stress::StressColumns;
use pellicle::summary::RunSummary;
use serde_json::Value;

/// Layers, each with thickness, Young's modulus and Poisson's ratio, on a base that is rigid if there is none.
#[derive(Debug, Clone)]
struct Body {
    layers: Vec<[f64; 3]>,
    base: Option<[f64; 2]>,
    strengths: &'static str,
}

impl Body {
    fn new(layers: &[[f64; 3]], base: Option<[f64; 2]>) -> Self {
        Self {
            layers: layers.to_vec(),
            base,
            strengths: "",
        }
    }

    /// As an inline table.
    fn text(&self) -> String {
        let material = |[e, nu]: [f64; 2]| format!("young_modulus = {e:e}, poisson_ratio = {nu}");
        let base = self.base.map(|base| format!("{{ {} }}", material(base)));
        let mut layers = String::new();
        for [thickness, e, nu] in &self.layers {
            let (material, strengths) = (material([*e, *nu]), self.strengths);
            write!(
                layers,
                "{{ thickness = {thickness:e}, {material}{strengths} }}, "
            )
            .expect("a text");
        }
        let base = base.unwrap_or("\"rigid\"".into());
        format!("{{ substrate = {base}, layer = [{layers}] }}")
    }

    fn scaled(&self, length: f64, modulus: f64) -> Self {
        let layer = |[thickness, e, nu]: &[f64; 3]| [length * thickness, modulus * e, *nu];
        Self {
            layers: self.layers.iter().map(layer).collect(),
            base: self.base.map(|[e, nu]| [modulus * e, nu]),
            ..*self
        }
    }

    /// The first layer in two parts.
    fn split(&self) -> Self {
        let mut layers = self.layers.clone();
        if let Some([thickness, e, nu]) = layers.first().copied() {
            layers[0] = [0.6 * thickness, e, nu];
            layers.insert(0, [0.4 * thickness, e, nu]);
        }
        Self {
            layers,
            ..self.clone()
        }
    }
}

/// Two bodies, and a paraboloid of this radius pressed on a square of this side by some forces.
#[derive(Debug, Clone)]
struct Scene {
    foundation: Body,
    indenter: Body,
    radius: f64,
    side: f64,
    forces: [f64; 2],
}

impl Scene {
    fn read(&self, more: &str) -> Result<Case, String> {
        let (foundation, body) = (self.foundation.text(), self.indenter.text());
        let [small, large] = self.forces;
        let text = format!(
            "foundation = {foundation}\n\
             indenter = {{ kind = \"paraboloid\", radius = {:e}, body = {body} }}\n\
             load = {{ forces = [{small:e}, {large:e}] }}\n\
             grid = {{ side = {:e}, elements = 32 }}\nsolver = {{ tolerance = 1e-11 }}\n{more}",
            self.radius, self.side
        );
        read(&text)
    }

    fn solved(&self, more: &str) -> RunSummary {
        let case = self.read(more).expect("a valid case");
        let run = case.solve(&mut ());
        let summary = run.expect("a solution").summary;
        assert!(
            summary.steps.iter().all(|step| step.certificate.satisfied),
            "{self:?}"
        );
        summary
    }

    fn swapped(&self) -> Self {
        Self {
            foundation: self.indenter.clone(),
            indenter: self.foundation.clone(),
            ..self.clone()
        }
    }
}

fn read(text: &str) -> Result<Case, String> {
    let source = Arc::new(Source::new("case.toml", text.to_owned()));
    let case = Case::parse(&source, "case", Path::new(""), &[]);
    case.map_err(|error| error.to_string())
}

/// Penetrations and largest pressures of the steps, over these units.
fn numbers(summary: &RunSummary, [length, modulus]: [f64; 2]) -> Vec<f64> {
    let of_step = |step: &pellicle::summary::StepSummary| {
        [
            step.penetration / length,
            step.summary.max_pressure / modulus,
        ]
    };
    summary.steps.iter().flat_map(of_step).collect()
}

fn assert_near(found: &[f64], wanted: &[f64], error: f64, scene: &Scene) {
    for (found, wanted) in found.iter().zip(wanted) {
        assert!(
            (found / wanted - 1.0).abs() <= error,
            "{found} {wanted}: {scene:?}"
        );
    }
}

/// Numbers between 0 and 1, the same in every run (Knuth's linear congruences).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        let [a, c] = [6_364_136_223_846_793_005_u64, 1_442_695_040_888_963_407];
        self.0 = self.0.wrapping_mul(a).wrapping_add(c);
        (self.0 >> 40) as f64 / 16_777_216.0
    }

    /// Between two numbers, evenly over their logarithm.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    fn body(&mut self, least: usize) -> Body {
        let count = least + usize::from(self.unit() < 0.5);
        let layers = (0..count).map(|_| {
            let (thickness, modulus) = (self.between(0.01, 0.3), self.between(0.1, 10.0));
            [thickness, modulus, 0.45 * self.unit()]
        });
        let layers = layers.collect();
        let is_rigid = count > 0 && self.unit() < 0.3;
        let base = [self.between(0.3, 3.0), 0.5 * self.unit()];
        Body {
            layers,
            base: (!is_rigid).then_some(base),
            strengths: "",
        }
    }

    fn scene(&mut self) -> Scene {
        Scene {
            foundation: self.body(0),
            indenter: self.body(1),
            radius: 1.0,
            side: 1.0,
            forces: [self.between(1e-4, 1e-3), self.between(1e-3, 1e-2)],
        }
    }
}

#[test]
fn random_bodies_may_be_swapped_scaled_and_split() {
    let mut random = Random(28);
    for _ in 0..8 {
        let scene = random.scene();
        let found = numbers(&scene.solved(""), [1.0; 2]);
        let swapped = numbers(&scene.swapped().solved(""), [1.0; 2]);
        assert_near(&swapped, &found, 0.0, &scene);
        let split = Scene {
            indenter: scene.indenter.split(),
            ..scene.clone()
        };
        // Solved to 1e-11.
        assert_near(&numbers(&split.solved(""), [1.0; 2]), &found, 1e-8, &scene);
        let (length, modulus) = (random.between(1e-7, 1e-2), random.between(1e3, 1e12));
        let scaled = Scene {
            foundation: scene.foundation.scaled(length, modulus),
            indenter: scene.indenter.scaled(length, modulus),
            radius: length,
            side: length,
            forces: scene.forces.map(|force| modulus * length * length * force),
        };
        let scaled = numbers(&scaled.solved(""), [length, modulus]);
        assert_near(&scaled, &found, 1e-8, &scene);
    }
}

fn coated() -> Body {
    Body {
        layers: vec![[0.05, 4.0, 0.25]],
        base: Some([1.0, 0.3]),
        strengths: ", yield_strength = 0.045, interface_shear_strength = 0.009",
    }
}

fn on_coated() -> Scene {
    Scene {
        foundation: Body::new(&[[0.2, 0.5, 0.4]], Some([2.0, 0.2])),
        indenter: coated(),
        radius: 1.0,
        side: 0.8,
        forces: [5e-4, 2e-3],
    }
}

#[test]
fn a_coated_ball_on_a_rigid_flat_is_a_rigid_ball_on_the_coated_body() {
    let scene = Scene {
        foundation: Body::new(&[], None),
        ..on_coated()
    };
    let text = |summary: &RunSummary| numbers(summary, [1.0; 2]);
    let found = text(&scene.solved(""));
    let body = coated().text();
    let on_body = read(&format!(
        "foundation = {body}\nindenter = {{ kind = \"paraboloid\", radius = 1.0 }}\n\
         load = {{ forces = [5e-4, 2e-3] }}\n\
         grid = {{ side = 0.8, elements = 32 }}\nsolver = {{ tolerance = 1e-11 }}\n"
    ));
    let run = on_body.expect("a case").solve(&mut ());
    assert_near(
        &found,
        &text(&run.expect("a solution").summary),
        0.0,
        &scene,
    );
}

/// The stresses of a summary as JSON, without the names of bodies and the direction of sliding.
fn stresses(summary: &RunSummary) -> Vec<Value> {
    let steps = summary.steps.iter().map(|step| {
        let stress = step.stress.as_ref().expect("stresses");
        serde_json::to_value(&stress.extremes)
    });
    let critical = serde_json::to_value(&summary.critical);
    let all = steps.chain([critical]).map(|value| {
        let text = value.expect("a value").to_string();
        serde_json::from_str(&text.replace("indenter.", "")).expect("a value")
    });
    all.collect()
}

#[test]
fn stresses_and_critical_loads_inside_the_indenter_are_those_of_the_same_body_as_the_foundation() {
    let scene = on_coated();
    let inside =
        scene.solved("stress = { body = \"indenter\", friction = 0.2, direction = \"30 deg\" }");
    let names = |summary: &RunSummary| -> Vec<String> {
        let critical = summary.critical.iter().flatten();
        critical.map(|load| load.name.clone()).collect()
    };
    assert_eq!(
        names(&inside),
        ["indenter.layer[0]", "indenter.interface[0]"]
    );
    // The foundation under it is dragged the other way.
    let swapped = scene.swapped();
    let same = swapped.solved("stress = { friction = 0.2, direction = \"210 deg\" }");
    let (found, wanted) = (stresses(&inside), stresses(&same));
    assert!(found[2][0]["force"].is_f64(), "{}", found[2]);
    assert_alike(&Value::from(found), &Value::from(wanted));
}

#[test]
fn stresses_in_both_bodies_are_those_of_each_one_after_the_other() {
    let scene = on_coated();
    let of = |body: &str| {
        let summary = scene.solved(&format!("stress = {{ body = \"{body}\", friction = 0.2 }}"));
        let columns = StressColumns::of_steps(&summary);
        (columns.header(Units::Si), summary)
    };
    let [(_, foundation), (_, indenter), (header, both)] =
        ["foundation", "indenter", "both"].map(of);
    for (k, step) in both.steps.iter().enumerate() {
        let extremes = |summary: &RunSummary| {
            let stress = summary.steps[k].stress.as_ref().expect("stresses");
            stress.extremes.clone()
        };
        let (found, [one, other]) = (extremes(&both), [&foundation, &indenter].map(extremes));
        assert_eq!(found.bodies, [one.bodies, other.bodies].concat());
        assert_eq!(
            found.interfaces,
            [one.interfaces, other.interfaces].concat()
        );
        // Each value of a row is under its own name.
        let columns = StressColumns::of_steps(&both);
        let row = columns.row(step, both.critical.as_deref().unwrap_or_default());
        for interface in &found.interfaces {
            let name = format!("max shear traction {} [Pa]", interface.name);
            let place = header.iter().position(|of| *of == name).expect("a column");
            let cell: f64 = row[place].parse().expect("a number");
            let wanted = interface.max_shear_traction.expect("wanted").value;
            assert!((cell / wanted - 1.0).abs() < 1e-12, "{name}");
        }
    }
    let critical = |summary: &RunSummary| summary.critical.clone().unwrap_or_default();
    assert_eq!(
        critical(&both),
        [critical(&foundation), critical(&indenter)].concat()
    );
}

/// The same numbers to 1e-6: the roundings of sine and cosine move the search's steps.
fn assert_alike(found: &Value, wanted: &Value) {
    match (found, wanted) {
        (Value::Array(found), Value::Array(wanted)) => {
            assert_eq!(found.len(), wanted.len());
            for (found, wanted) in found.iter().zip(wanted) {
                assert_alike(found, wanted);
            }
        }
        (Value::Object(found), Value::Object(wanted)) => {
            assert!(found.keys().eq(wanted.keys()));
            for (key, found) in found.iter().filter(|(key, _)| *key != "estimate") {
                assert_alike(found, &wanted[key]);
            }
        }
        (Value::Number(found), Value::Number(wanted)) => {
            let [found, wanted] = [found, wanted].map(|of| of.as_f64().expect("a number"));
            let error = (found - wanted).abs();
            assert!(error <= 1e-6 * wanted.abs().max(1e-3), "{found} {wanted}");
        }
        _ => assert_eq!(found, wanted),
    }
}

#[test]
fn a_case_with_two_bodies_is_read_back_as_it_was() {
    let case = on_coated()
        .read("stress = { body = \"indenter\" }")
        .expect("a case");
    let text = toml::to_string(&case).expect("a text");
    assert!(
        text.contains("[indenter.body") && text.contains("body = \"indenter\""),
        "{text}"
    );
    let again = read(&text).expect("a case");
    assert_eq!(
        serde_json::to_value(&again).ok(),
        serde_json::to_value(&case).ok()
    );
}

#[test]
fn what_does_not_deform_is_refused_in_one_sentence() {
    let rigid = Body::new(&[], None);
    let on_rigid = Scene {
        foundation: rigid.clone(),
        ..on_coated()
    };
    let text = |indenter: &str| {
        format!(
            "foundation = {{ substrate = \"rigid\" }}\n\
             indenter = {{ kind = \"paraboloid\", radius = 1.0{indenter} }}\nload = {{ force = 1.0 }}\n"
        )
    };
    for (found, wanted) in [
        (
            read(&text("")),
            "key `foundation.substrate`: found no elastic layer on a rigid base",
        ),
        (
            read(&text(", body = { substrate = \"rigid\" }")),
            "key `indenter.body.substrate`: found \"rigid\", without layers on it",
        ),
        (
            on_rigid.read("[stress]\n"),
            "key `stress.body`: found no such key, wanted \"indenter\": the foundation is rigid",
        ),
        (
            on_rigid.read("[stress]\nbody = \"foundation\"\n"),
            "key `stress.body`: found \"foundation\", which is rigid",
        ),
        (
            on_rigid.read("[stress]\nbody = \"both\"\n"),
            "key `stress.body`: found \"both\", with a rigid body, wanted the one that deforms",
        ),
    ] {
        let found = found.map(|_| ()).expect_err("a refusal");
        assert!(found.contains(wanted), "{found}\n{wanted}");
    }
    // A half-space is a body that gives.
    assert!(read(&text(", young_modulus = 1.0, poisson_ratio = 0.3")).is_ok());
}
