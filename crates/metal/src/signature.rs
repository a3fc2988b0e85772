//! The signature of an entry point, read from the emitted text: what each parameter and each value of a stage is, by its attribute.

use bossage_translate::Stage;

/// What an attribute says that a parameter or a member is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Role {
    Buffer(u32),
    Texture(u32),
    Sampler(u32),
    /// Memory of the workgroup, which has no attribute.
    Workgroup,
    /// The struct with what came from the stage before.
    StageIn,
    GridPosition,
    WorkgroupPosition,
    PositionInWorkgroup,
    IndexInWorkgroup,
    Workgroups,
    /// A vertex attribute, a value between stages, or a colour, by its location.
    Location(u32),
    Position,
    VertexIndex,
    InstanceIndex,
    FrontFacing,
    PrimitiveIndex,
    SampleIndex,
    SampleMask,
    Depth,
}

/// A parameter of an entry point, or a member of its structs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Declared {
    pub(crate) name: String,
    pub(crate) role: Role,
}

/// An entry point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Signature {
    pub(crate) name: String,
    pub(crate) stage: Stage,
    pub(crate) parameters: Vec<Declared>,
    /// What came from the stage before.
    pub(crate) members_in: Vec<Declared>,
    /// What the stage gives.
    pub(crate) members_out: Vec<Declared>,
    /// Whether invocations wait for each other: for a workgroup, or for their quad.
    pub(crate) waits: bool,
}

/// Words of MSL after which invocations exchange values or wait.
const MEETINGS: [&str; 6] = [
    "threadgroup_barrier(",
    "dfdx(",
    "dfdy(",
    "fwidth(",
    ".sample(",
    ".sample_compare(",
];

impl Signature {
    /// Reads the entry point of that name.
    ///
    /// # Errors
    /// What is not as emitted text has it, or what cannot be handed over.
    pub(crate) fn read(text: &str, stage: Stage, name: &str) -> Result<Self, String> {
        let word = match stage {
            Stage::Compute => "kernel ",
            Stage::Vertex => "vertex ",
            Stage::Fragment => "fragment ",
        };
        let (result, list) = declaration(text, word, name)
            .ok_or_else(|| format!("the text has no `{word}` of the name `{name}`"))?;
        let mut signature = Self {
            name: name.to_owned(),
            stage,
            parameters: Vec::new(),
            members_in: Vec::new(),
            members_out: Vec::new(),
            waits: MEETINGS.iter().any(|meeting| text.contains(meeting)),
        };
        for parameter in apart(list) {
            let declared = declared(parameter)?;
            if declared.role == Role::StageIn {
                let ty = parameter.split_whitespace().next().unwrap_or_default();
                signature.members_in = members(text, ty)?;
            }
            signature.parameters.push(declared);
        }
        if result != "void" {
            signature.members_out = members(text, result)?;
        }
        Ok(signature)
    }

    /// What an invocation gets as words, in their order: the members, then the parameters that are values of the stage.
    pub(crate) fn values_in(&self) -> impl Iterator<Item = &Declared> {
        let of_stage = |declared: &&Declared| declared.role.is_stage_value();
        self.members_in
            .iter()
            .chain(self.parameters.iter().filter(of_stage))
    }
}

impl Role {
    /// Whether it comes to each invocation of a vertex or fragment stage as words.
    pub(crate) fn is_stage_value(self) -> bool {
        match self {
            Self::Location(_)
            | Self::Position
            | Self::VertexIndex
            | Self::InstanceIndex
            | Self::FrontFacing
            | Self::PrimitiveIndex
            | Self::SampleIndex
            | Self::SampleMask
            | Self::Depth => true,
            Self::Buffer(_)
            | Self::Texture(_)
            | Self::Sampler(_)
            | Self::Workgroup
            | Self::StageIn
            | Self::GridPosition
            | Self::WorkgroupPosition
            | Self::PositionInWorkgroup
            | Self::IndexInWorkgroup
            | Self::Workgroups => false,
        }
    }

    fn of(attribute: &str) -> Result<Self, String> {
        let (word, number) = match attribute.split_once('(') {
            Some((word, rest)) => (word, rest.trim_end_matches(')').trim_start_matches("loc")),
            None => (attribute, ""),
        };
        let unknown = || format!("nothing is known to hand over as [[{attribute}]]");
        let index = || number.parse::<u32>().map_err(|_| unknown());
        Ok(match word {
            "buffer" => Self::Buffer(index()?),
            "texture" => Self::Texture(index()?),
            "sampler" => Self::Sampler(index()?),
            "attribute" | "user" | "color" => Self::Location(index()?),
            "stage_in" => Self::StageIn,
            "thread_position_in_grid" => Self::GridPosition,
            "threadgroup_position_in_grid" => Self::WorkgroupPosition,
            "thread_position_in_threadgroup" => Self::PositionInWorkgroup,
            "thread_index_in_threadgroup" => Self::IndexInWorkgroup,
            "threadgroups_per_grid" => Self::Workgroups,
            "position" => Self::Position,
            "vertex_id" => Self::VertexIndex,
            "instance_id" => Self::InstanceIndex,
            "front_facing" => Self::FrontFacing,
            "primitive_id" => Self::PrimitiveIndex,
            "sample_id" => Self::SampleIndex,
            "sample_mask" => Self::SampleMask,
            "depth" => Self::Depth,
            _ => return Err(unknown()),
        })
    }
}

/// The type that an entry point returns, and the text between its parentheses.
fn declaration<'a>(text: &'a str, word: &str, name: &str) -> Option<(&'a str, &'a str)> {
    let call = format!(" {name}(");
    text.match_indices(&call).find_map(|(at, _)| {
        let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
        let before = &text[line..at];
        let result = &before[before.find(word)? + word.len()..];
        let start = at + call.len();
        let end = start + closing(&text[start..])?;
        Some((result.trim(), &text[start..end]))
    })
}

/// Where the parenthesis is closed that was opened before this text.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 1;
    text.char_indices().find_map(|(at, letter)| {
        match letter {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        (depth == 0).then_some(at)
    })
}

/// The parts between the commas that stand in no bracket.
fn apart(list: &str) -> Vec<&str> {
    let (mut parts, mut start, mut depth) = (Vec::new(), 0, 0);
    for (at, letter) in list.char_indices() {
        match letter {
            '<' | '[' | '(' => depth += 1,
            '>' | ']' | ')' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(list[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(list[start..].trim());
    parts.retain(|part| !part.is_empty());
    parts
}

/// `metal::float2 uv [[user(loc0), center_perspective]]`
fn declared(text: &str) -> Result<Declared, String> {
    let (head, attribute) = match text.split_once("[[") {
        Some((head, rest)) => (head, rest.split("]]").next()),
        None => (text, None),
    };
    let name = head.trim_end().rsplit([' ', '&', '*']).next().unwrap_or_default();
    let role = match attribute {
        Some(list) => Role::of(list.split(", ").next().unwrap_or_default().trim())?,
        None if head.trim_start().starts_with("threadgroup ") => Role::Workgroup,
        None => return Err(format!("`{}` has no attribute", text.trim())),
    };
    Ok(Declared {
        name: name.to_owned(),
        role,
    })
}

/// The members of a struct.
fn members(text: &str, name: &str) -> Result<Vec<Declared>, String> {
    let missing = || format!("the text has no struct `{name}`");
    let head = format!("struct {name} {{");
    let start = text.find(&head).ok_or_else(missing)? + head.len();
    let end = start + text[start..].find("};").ok_or_else(missing)?;
    let lines = text[start..end].split(';').map(str::trim);
    lines.filter(|line| !line.is_empty()).map(declared).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAGMENT: &str = "
struct fsInput {
    metal::float3 world [[user(loc0), center_perspective]];
    uint kind [[user(loc2), flat]];
};
struct fsOutput {
    metal::float4 colour [[color(0)]];
    float depth [[depth(any)]];
};
fragment fsOutput fs(
  fsInput varyings [[stage_in]]
, metal::float4 at [[position]]
, bool front [[front_facing]]
, constant Globals& globals [[buffer(0)]]
, metal::texture2d<float, metal::access::sample> map [[texture(1)]]
, metal::sampler s [[sampler(0)]]
) {
    return fsOutput { map.sample(s, varyings.world.xy), 0.5 };
}
";

    fn roles(list: &[Declared]) -> Vec<(&str, Role)> {
        list.iter().map(|d| (d.name.as_str(), d.role)).collect()
    }

    #[test]
    fn a_fragment_stage_is_read() {
        let read = Signature::read(FRAGMENT, Stage::Fragment, "fs").unwrap();
        assert_eq!(
            roles(&read.parameters),
            [
                ("varyings", Role::StageIn),
                ("at", Role::Position),
                ("front", Role::FrontFacing),
                ("globals", Role::Buffer(0)),
                ("map", Role::Texture(1)),
                ("s", Role::Sampler(0)),
            ]
        );
        assert_eq!(
            roles(&read.members_in),
            [("world", Role::Location(0)), ("kind", Role::Location(2))]
        );
        assert_eq!(
            roles(&read.members_out),
            [("colour", Role::Location(0)), ("depth", Role::Depth)]
        );
        assert!(read.waits);
        let values: Vec<&str> = read.values_in().map(|d| d.name.as_str()).collect();
        assert_eq!(values, ["world", "kind", "at", "front"]);
    }

    #[test]
    fn a_kernel_with_workgroup_memory_is_read() {
        let text = "struct mainInput {\n};\n[[max_total_threads_per_threadgroup(64)]] kernel void main_(\n  metal::uint3 id \
                    [[thread_position_in_grid]]\n, device type_1 const& inputs [[buffer(0)]]\n, threadgroup type_2& shared\n) {\n}\n";
        let read = Signature::read(text, Stage::Compute, "main_").unwrap();
        assert_eq!(
            roles(&read.parameters),
            [
                ("id", Role::GridPosition),
                ("inputs", Role::Buffer(0)),
                ("shared", Role::Workgroup),
            ]
        );
        assert!(!read.waits && read.members_out.is_empty());
    }

    #[test]
    fn what_cannot_be_handed_over_is_named() {
        let text = "kernel void main_(\n  uint lane [[thread_index_in_simdgroup]]\n) {\n}\n";
        let said = Signature::read(text, Stage::Compute, "main_").unwrap_err();
        assert!(said.contains("[[thread_index_in_simdgroup]]"), "{said}");
        assert!(
            Signature::read(text, Stage::Compute, "other")
                .unwrap_err()
                .contains("`other`")
        );
        assert!(Signature::read(text, Stage::Vertex, "main_").is_err());
    }
}
