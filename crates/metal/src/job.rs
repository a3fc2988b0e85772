//! A job as words, in the order in which the program around a shader reads them.

/// Bytes that begin each job, and each answer; and the word that ends an answer.
const JOB: u32 = 0x314c_534d;
pub(crate) const BEGIN: u32 = 0x4f4b_4159;
pub(crate) const END: u32 = 0x444f_4e45;

/// Bytes that grow.
#[derive(Default)]
pub(crate) struct Words(Vec<u8>);

impl Words {
    /// The beginning of a job.
    pub(crate) fn job() -> Self {
        let mut words = Self::default();
        words.word(JOB);
        words
    }

    pub(crate) fn word(&mut self, word: u32) {
        self.0.extend_from_slice(&word.to_le_bytes());
    }

    pub(crate) fn float(&mut self, value: f32) {
        self.word(value.to_bits());
    }

    /// Their number, then the bytes, filled up to whole words.
    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        self.word(bytes.len() as u32);
        self.0.extend_from_slice(bytes);
        self.0.resize(self.0.len().next_multiple_of(4), 0);
    }

    pub(crate) fn append(&mut self, other: &Self) {
        self.0.extend_from_slice(&other.0);
    }

    pub(crate) fn as_bytes(&self) -> &[u8] {
        &self.0
    }
}
