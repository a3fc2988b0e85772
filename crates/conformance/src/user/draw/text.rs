//! The generated stages, as WGSL.
//!
//! Every name begins with `bossage_`, so that none hides one of the shader's. All values of a job stand in one uniform array, four words each: for every corner of every triangle its place, then the stage's inputs.

use bossage_translate::Callable;

use super::port::Port;

/// Targets of a pass: as many as any adapter has room for.
pub(super) const TARGETS: usize = 4;

/// Where the array is bound, and how long it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Feed {
    pub(super) binding: (u32, u32),
    /// Values of one corner, its place included.
    pub(super) stride: usize,
    pub(super) corners: usize,
}

impl Feed {
    fn declaration(self) -> String {
        let ((group, binding), words) = (self.binding, self.stride * self.corners);
        format!(
            "@group({group}) @binding({binding}) var<uniform> bossage_inputs: array<vec4<u32>, {words}>;\n"
        )
    }

    /// The first lines of a vertex stage.
    fn place(self) -> String {
        format!(
            "    let bossage_at = u32(bossage_corner) * {}u;\n    let bossage_place = bitcast<vec4<f32>>(bossage_inputs[bossage_at]);\n",
            self.stride
        )
    }

    /// The expressions of the inputs.
    fn values(ports: &[Port]) -> Vec<String> {
        let value =
            |(at, port): (usize, &Port)| port.unpacked(&format!("bossage_inputs[bossage_at + {}u]", at + 1));
        ports.iter().enumerate().map(value).collect()
    }
}

/// For a fragment stage: a vertex stage that feeds it, and fragment stages that show what arrives.
pub(super) fn around_fragments(feed: Feed, inputs: &[Port]) -> String {
    let located: Vec<Port> = inputs.iter().filter(|port| port.is_located()).cloned().collect();
    let members = list(&located, |at, port| {
        format!("    {},\n", port.declared(&format!("bossage_v{}", letter(at))))
    });
    let values = Feed::values(&located);
    let mut text = feed.declaration();
    text += &format!("struct BossageFed {{\n    @builtin(position) place: vec4<f32>,\n{members}}}\n");
    text += &format!(
        "@vertex fn bossage_feed(@location(0) bossage_corner: f32) -> BossageFed {{\n{}    return BossageFed(bossage_place{});\n}}\n",
        feed.place(),
        values
            .iter()
            .map(|value| format!(", {value}"))
            .collect::<String>()
    );
    let arguments: Vec<String> = inputs
        .iter()
        .enumerate()
        .map(|(at, port)| port.declared(&format!("bossage_v{}", letter(at))))
        .collect();
    let shown: Vec<(String, &Port)> = inputs
        .iter()
        .enumerate()
        .map(|(at, port)| (format!("bossage_v{}", letter(at)), port))
        .collect();
    for (number, part) in shown.chunks(TARGETS).enumerate() {
        let packed: Vec<String> = part.iter().map(|(name, port)| port.packed(name)).collect();
        text += &fragment("capture", number, &arguments.join(", "), &packed);
    }
    text
}

/// What a vertex stage that is a function returns, handed on by a vertex stage that calls it: the text to add to it.
pub(super) fn call_vertex(feed: Feed, callable: &Callable, inputs: &[Port], outputs: &[Port]) -> String {
    let results = callable.outputs("bossage_result");
    let packed: Vec<String> = outputs
        .iter()
        .zip(&results)
        .map(|(port, value)| port.packed(value))
        .collect();
    let members: String = (0..outputs.len())
        .map(|at| format!("    {},\n", handed(at)))
        .collect();
    format!(
        "\n{}struct BossageFed {{\n    @builtin(position) place: vec4<f32>,\n{members}}}\n\
        @vertex fn bossage_call(@location(0) bossage_corner: f32) -> BossageFed {{\n{}    let bossage_result = {};\n    return BossageFed(bossage_place, {});\n}}\n",
        feed.declaration(),
        feed.place(),
        callable.call(&Feed::values(inputs)),
        packed.join(", ")
    )
}

/// For a vertex stage: fragment stages that keep what is handed on.
pub(super) fn after_vertices(outputs: usize) -> String {
    let arguments: Vec<String> = (0..outputs).map(handed).collect();
    let names: Vec<String> = (0..outputs)
        .map(|at| format!("bossage_v{}", letter(at)))
        .collect();
    let parts = names.chunks(TARGETS).enumerate();
    parts
        .map(|(number, part)| fragment("store", number, &arguments.join(", "), part))
        .collect()
}

/// A fragment stage that is a function, called by one whose outputs fit every target: the text to add to it.
pub(super) fn call_fragment(callable: &Callable, inputs: &[Port], outputs: &[Port]) -> String {
    let arguments: Vec<String> = inputs
        .iter()
        .enumerate()
        .map(|(at, port)| port.declared(&format!("bossage_v{}", letter(at))))
        .collect();
    let names: Vec<String> = (0..inputs.len())
        .map(|at| format!("bossage_v{}", letter(at)))
        .collect();
    let results = callable.outputs("bossage_result");
    let packed: Vec<String> = outputs
        .iter()
        .zip(&results)
        .map(|(port, value)| port.packed(value))
        .collect();
    let members = list(outputs, |at, _| {
        format!("    @location({at}) t{}: vec4<u32>,\n", letter(at))
    });
    format!(
        "\nstruct BossageKept {{\n{members}}}\n@fragment fn bossage_call({}) -> BossageKept {{\n    let bossage_result = {};\n    return BossageKept({});\n}}\n",
        arguments.join(", "),
        callable.call(&names),
        packed.join(", ")
    )
}

/// The name of a generated fragment stage.
pub(super) fn name(word: &str, number: usize) -> String {
    format!("bossage_{word}_{}", letter(number))
}

fn fragment(word: &str, number: usize, arguments: &str, values: &[String]) -> String {
    let kept = format!("Bossage{word}{}", letter(number));
    let members: String = (0..values.len())
        .map(|at| format!("    @location({at}) t{}: vec4<u32>,\n", letter(at)))
        .collect();
    format!(
        "struct {kept} {{\n{members}}}\n@fragment fn {}({arguments}) -> {kept} {{\n    return {kept}({});\n}}\n",
        name(word, number),
        values.join(", ")
    )
}

/// Four words on their way from a vertex stage to a fragment stage.
fn handed(at: usize) -> String {
    format!(
        "@location({at}) @interpolate(flat) bossage_v{}: vec4<u32>",
        letter(at)
    )
}

fn list(ports: &[Port], one: impl Fn(usize, &Port) -> String) -> String {
    ports.iter().enumerate().map(|(at, port)| one(at, port)).collect()
}

/// Names that end in a letter stay as they are in every language.
fn letter(at: usize) -> char {
    char::from(b'a' + (at % 26) as u8)
}
