//! What can go wrong when a shader is run, each variant naming the thing and, where there is one, the way out.

use bossage_translate::manifest::Entry;

/// A failure to run something.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// No Vulkan adapter is there at all. A command line exits with 3 on this.
    #[error("no Vulkan adapter found: {HOW_TO_GET_AN_ADAPTER}")]
    NoAdapter,
    /// Adapters are there, but none that the selector names. A command line exits with 3 on this.
    #[error("no adapter matches `{wanted}`; there are: {}", .found.join(", "))]
    NoSuchAdapter {
        /// What was asked for.
        wanted: String,
        /// The names of the adapters that are there.
        found: Vec<String>,
    },
    /// The adapter is there, but it can't be opened as a device.
    #[error("adapter `{adapter}` can't be opened")]
    Open {
        /// The adapter's name.
        adapter: String,
        /// What it said.
        source: wgpu::RequestDeviceError,
    },
    /// The adapter lacks something that this job needs.
    #[error("`{job}`: adapter `{adapter}` lacks {what}")]
    Unsupported {
        /// The job that was asked for.
        job: String,
        /// The adapter's name.
        adapter: String,
        /// What it lacks.
        what: String,
    },
    /// The job was refused: the shader, its interface or the bound resources don't fit together.
    #[error("`{job}` is not valid: {message}")]
    Validation {
        /// The job.
        job: String,
        /// What was wrong, in wgpu's words.
        message: String,
    },
    /// The device had no memory for the job.
    #[error("`{job}`: the device is out of memory")]
    OutOfMemory {
        /// The job.
        job: String,
    },
    /// The driver failed in a way that is neither the job's fault nor a lack of memory.
    #[error("`{job}`: the driver failed: {message}")]
    Internal {
        /// The job.
        job: String,
        /// What it said.
        message: String,
    },
    /// The machine began and gave up: a budget is used up, or the job asks for what it can't do after all.
    #[error("`{job}`: {machine} gave up: {message}")]
    GaveUp {
        /// The job.
        job: String,
        /// The machine's name.
        machine: String,
        /// What it said.
        message: String,
    },
    /// The device is gone; every later job on it fails as well. Open a new one.
    #[error("`{job}`: the device was lost: {message}")]
    Lost {
        /// The job that noticed.
        job: String,
        /// What the driver said.
        message: String,
    },
    /// A manifest entry says something that the runner doesn't understand.
    #[error("entry `{entry}`: binding or value `{name}`: {problem}")]
    Interface {
        /// The entry point.
        entry: String,
        /// The binding, input or output.
        name: String,
        /// What is wrong with it.
        problem: String,
    },
    /// The two stages of a draw disagree about a binding.
    #[error(
        "`{job}`: the stages disagree about @group({group}) @binding({binding}): `{first}` against `{second}`"
    )]
    StagesDisagree {
        /// The job.
        job: String,
        /// The bind group.
        group: u32,
        /// The binding in it.
        binding: u32,
        /// One stage's declaration.
        first: String,
        /// The other's.
        second: String,
    },
    /// The two stages of a draw take different routes.
    #[error(
        "`{job}`: the vertex stage takes the route `{vertex}`, the fragment stage `{fragment}`; both must take one"
    )]
    MixedRoutes {
        /// The job.
        job: String,
        /// The vertex stage's route.
        vertex: &'static str,
        /// The fragment stage's route.
        fragment: &'static str,
    },
    /// The shader binds something that the job gives no resource for.
    #[error("`{job}`: nothing is given for binding `{name}` (@group({group}) @binding({binding}), {kind})")]
    MissingResource {
        /// The job.
        job: String,
        /// The binding's name.
        name: String,
        /// The bind group.
        group: u32,
        /// The binding in it.
        binding: u32,
        /// What it should be.
        kind: String,
    },
    /// A resource is of another kind than its binding.
    #[error("`{job}`: binding `{name}` is a {expected}, but a {given} is given")]
    WrongResource {
        /// The job.
        job: String,
        /// The binding's name.
        name: String,
        /// What the shader declares.
        expected: String,
        /// What the job gives.
        given: String,
    },
    /// The job gives a resource for a binding that the shader doesn't have.
    #[error("`{job}`: the shader has no binding `{name}`; it has: {}", .known.join(", "))]
    UnknownResource {
        /// The job.
        job: String,
        /// The resource's key.
        name: String,
        /// The bindings that the shader has.
        known: Vec<String>,
    },
    /// No value is given for a member of a uniform.
    #[error("`{job}`: no value is given for the uniform `{member}` ({kind})")]
    MissingUniform {
        /// The job.
        job: String,
        /// `variable.member`.
        member: String,
        /// Its WGSL type.
        kind: String,
    },
    /// A value doesn't fit the uniform's member.
    #[error("`{job}`: uniform `{member}`: {problem}")]
    BadUniform {
        /// The job.
        job: String,
        /// `variable.member`.
        member: String,
        /// What doesn't fit.
        problem: String,
    },
    /// The mesh lacks a vertex attribute that the vertex stage reads, or has it in the wrong shape.
    #[error("`{job}`: vertex attribute `{attribute}`: {problem}")]
    Mesh {
        /// The job.
        job: String,
        /// The attribute, or `indices`.
        attribute: String,
        /// What is wrong.
        problem: String,
    },
    /// A texture's data is impossible.
    #[error("texture `{name}`: {problem}")]
    Texture {
        /// The texture, as the job calls it.
        name: String,
        /// What is wrong.
        problem: String,
    },
    /// A render target can't hold what it should.
    #[error("`{job}`: target {location}: {problem}")]
    Target {
        /// The job.
        job: String,
        /// The target's `@location`.
        location: usize,
        /// What is wrong.
        problem: String,
    },
    /// A size or count is impossible or beyond the adapter's limit.
    #[error("`{job}`: {what} is {given}, the limit is {limit}")]
    TooLarge {
        /// The job.
        job: String,
        /// What is too large.
        what: &'static str,
        /// The value given.
        given: u64,
        /// The largest that goes.
        limit: u64,
    },
    /// SPIR-V bytes that can't be a module.
    #[error("`{job}`: not a SPIR-V module: {problem}")]
    NotSpirv {
        /// The job.
        job: String,
        /// Why not.
        problem: String,
    },
    /// An input whose length doesn't match its description.
    #[error("`{job}`: {what}: {given} values given, {expected} expected")]
    Length {
        /// The job.
        job: String,
        /// Which input.
        what: String,
        /// How many there are.
        given: usize,
        /// How many there should be.
        expected: usize,
    },
}

/// Said wherever an adapter is missing.
pub const HOW_TO_GET_AN_ADAPTER: &str = "a driver is needed, if only a software one: on Debian or Ubuntu `apt-get install \
     libvulkan1 mesa-vulkan-drivers`, or `./x setup` in this repository";

impl Error {
    /// The machine of that name lacks something that the job needs.
    #[must_use]
    pub fn unsupported(job: &str, adapter: &str, what: impl Into<String>) -> Self {
        Self::Unsupported {
            job: job.to_owned(),
            adapter: adapter.to_owned(),
            what: what.into(),
        }
    }

    /// The machine of that name began and gave up.
    #[must_use]
    pub fn gave_up(job: &str, machine: &str, message: impl Into<String>) -> Self {
        Self::GaveUp {
            job: job.to_owned(),
            machine: machine.to_owned(),
            message: message.into(),
        }
    }

    /// The job is refused.
    #[must_use]
    pub fn invalid(job: &str, message: impl Into<String>) -> Self {
        Self::Validation {
            job: job.to_owned(),
            message: message.into(),
        }
    }

    /// An entry of a manifest that the machine can't serve, or that doesn't fit its job.
    #[must_use]
    pub fn misfit(entry: &Entry, name: &str, problem: impl Into<String>) -> Self {
        Self::Interface {
            entry: entry.name.clone(),
            name: name.to_owned(),
            problem: problem.into(),
        }
    }

    /// Whether the environment lacks what was demanded (exit code 3), rather than the job being wrong.
    #[must_use]
    pub fn is_missing_environment(&self) -> bool {
        matches!(
            self,
            Self::NoAdapter | Self::NoSuchAdapter { .. } | Self::Open { .. } | Self::Unsupported { .. }
        )
    }
}
