// Types of first_study.mjs.
export const FIRST_STUDY: string;
