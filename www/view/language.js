/** Goes over to the other language. */
import { language, switchLanguage, t } from '../text/index.js';
import { h } from './dom.js';

export function languageButton() {
  return h(
    'button',
    {
      type: 'button',
      class: 'quiet',
      name: 'language',
      lang: language === 'zh' ? 'en' : 'zh',
      onclick: switchLanguage,
    },
    t('action.language'),
  );
}
