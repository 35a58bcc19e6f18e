// YAML as editors read it: version 1.2, with merge keys.
'use strict';

const YAML = require('yaml');

/** What a text says, as {document}; {refused}, the reason, if it is not one document of YAML. */
function readYaml(text) {
  const documents = YAML.parseAllDocuments(text, {merge: true, logLevel: 'silent'});
  if (documents.length > 1) return {refused: 'several documents'};
  if (documents.length === 0) return {document: null};
  const [document] = documents;
  if (document.errors.length > 0) return {refused: document.errors[0].message};
  try {
    return {document: document.toJS()};
  } catch (error) {
    return {refused: error.message}; // an alias without an anchor, or too many of them
  }
}

module.exports = {readYaml};
